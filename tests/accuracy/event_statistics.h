// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_statistics.h
/// Summary statistics of event sizes.
#ifndef LSM_ACCURACY_EVENT_STATISTICS_H
#define LSM_ACCURACY_EVENT_STATISTICS_H

#include <cmath>
#include <vector>

namespace Accuracy {

/// Estimate with its standard error.
struct Estimate {
  double value = NAN, error = NAN;
};

/// Mean, with the standard error for independent samples.
inline Estimate mean(const std::vector<double> &x) {
  double sum = 0.0, squares = 0.0;
  for (double v : x) sum += v;
  const double n = static_cast<double>(x.size()), m = sum / n;
  for (double v : x) squares += (v - m) * (v - m);
  return {m, std::sqrt(squares / (n - 1.0) / n)};
}

/// The characteristic size <s^2> / <s>, with its error by linear propagation.
inline Estimate characteristic_size(const std::vector<double> &x) {
  double s1 = 0.0, s2 = 0.0, var = 0.0;
  for (double v : x) {
    s1 += v;
    s2 += v * v;
  }
  const double star = s2 / s1;
  for (double v : x) var += v * v * (v - star) * (v - star);
  return {star, std::sqrt(var) / s1};
}

/// Exponent of a density x^-alpha on [lo, hi] by maximum likelihood; NaN with fewer than 10 values.
inline Estimate exponent(const std::vector<double> &x, double lo, double hi) {
  double logs = 0.0, n = 0.0;
  for (double v : x)
    if (v >= lo && v <= hi) {
      logs += std::log(v / lo);
      n += 1.0;
    }
  if (n < 10.0) return {};
  const double range = std::log(hi / lo), mean_log = logs / n;
  // y = log(x / lo) has density ~ exp(b y) on [0, range], b = 1 - alpha; its mean grows with b.
  auto expected = [&](double b) {
    return std::fabs(b * range) < 1e-4 ? range * (0.5 + b * range / 12.0)
                                       : range / (1.0 - std::exp(-b * range)) - 1.0 / b;
  };
  double low = -50.0, high = 50.0;
  for (int k = 0; k < 100; ++k) {
    const double mid = 0.5 * (low + high);
    (expected(mid) < mean_log ? low : high) = mid;
  }
  const double b = 0.5 * (low + high), step = 1e-3;
  const double variance = (expected(b + step) - expected(b - step)) / (2.0 * step);
  return {1.0 - b, 1.0 / std::sqrt(n * variance)};
}

}  // namespace Accuracy

#endif
