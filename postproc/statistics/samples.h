// SPDX-License-Identifier: GPL-2.0-or-later
/// \file samples.h
/// Operations on samples shared by many estimators.
#ifndef LSM_POSTPROC_SAMPLES_H
#define LSM_POSTPROC_SAMPLES_H

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "lsm_random.h"
#include "lsm_sum.h"

namespace LSM::postproc {

/// Smallest and largest of the values seen.
struct Extent {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  void add(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  bool empty() const { return !(hi >= lo); }
};

/// NaN without values.
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

/// The values divided by their mean.
inline std::vector<double> over_mean(std::vector<double> values) {
  const double mean = mean_of(values);
  for (double &value : values) value /= mean;
  return values;
}

/// Value of a curve of straight lines through the points (x, y), x ascending; constant beyond its
/// ends.
inline double interpolate(const std::vector<double> &x, const std::vector<double> &y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto n = static_cast<std::size_t>(above - x.begin());
  return y[n - 1] + (y[n] - y[n - 1]) * (at - x[n - 1]) / (x[n] - x[n - 1]);
}

/// A whole number from 0 to count - 1.
inline std::size_t draw_index(Random &random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/// Puts values into random order (Fisher and Yates, from the end).
template <class T>
void shuffle(std::vector<T> &values, Random &random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[draw_index(random, i)]);
}

}  // namespace LSM::postproc

#endif
