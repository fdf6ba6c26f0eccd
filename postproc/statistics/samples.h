// SPDX-License-Identifier: GPL-2.0-or-later
/// \file samples.h
/// Operations on samples shared by many estimators.
#ifndef LSM_POSTPROC_SAMPLES_H
#define LSM_POSTPROC_SAMPLES_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numerics/random.h"
#include "numerics/sum.h"

namespace LSM::postproc {

/// A range of sizes or times, or of the values that were added.
struct Range {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  void add(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  /// Whether no value (other than NaN) has been added.
  bool empty() const { return !(hi >= lo); }
};

/// A number and its standard error.
struct Measured {
  double value = NAN;
  double error = NAN;
};

/// A share that was found from so many random samples, with its binomial standard error.
inline Measured share_of(double share, double samples) {
  return {share, std::sqrt(share * (1.0 - share) / samples)};
}

/// Data from which a result cannot be computed or drawn, such as too few events. Other errors, of
/// files and programs, are no DegenerateData.
struct DegenerateData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Marks a result as one without numbers and gives the reason.
template <class Fit>
Fit without_numbers(Fit fit, std::string why) {
  fit.why = std::move(why);
  return fit;
}

/// Arithmetic mean; NaN without values.
inline double mean_of(const double *values, std::size_t count) {
  return sum_pairwise(values, count) / static_cast<double>(count);
}
inline double mean_of(const std::vector<double> &values) {
  return mean_of(values.data(), values.size());
}

/// The values minus their mean.
inline std::vector<double> centred(std::vector<double> values) {
  const double mean = mean_of(values);
  for (double &value : values) value -= mean;
  return values;
}

/// Each value minus the preceding one; empty for fewer than two values.
inline std::vector<double> differences(std::vector<double> values) {
  std::adjacent_difference(values.begin(), values.end(), values.begin());
  if (!values.empty()) values.erase(values.begin());
  return values;
}

/// Linear interpolation between the points (x, y) with ascending x; constant beyond the ends.
inline double interpolate(const std::vector<double> &x, const std::vector<double> &y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto n = static_cast<std::size_t>(above - x.begin());
  return y[n - 1] + (y[n] - y[n - 1]) * (at - x[n - 1]) / (x[n] - x[n - 1]);
}

/// The n-th largest value, n from 1 to the number of values.
inline double nth_largest(std::vector<double> values, std::size_t n) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n - 1);
  std::nth_element(values.begin(), nth, values.end(), [](double a, double b) { return a > b; });
  return *nth;
}

/// Random integer from 0 to count - 1.
inline std::size_t draw_index(Random &random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/// Random permutation (Fisher and Yates, from the end).
template <class T>
void shuffle(std::vector<T> &values, Random &random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[draw_index(random, i)]);
}

}  // namespace LSM::postproc

#endif
