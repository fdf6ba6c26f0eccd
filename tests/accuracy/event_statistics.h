// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_statistics.h
/// Event sizes in a few numbers, and the two-sample Kolmogorov-Smirnov test.
#ifndef LSM_ACCURACY_EVENT_STATISTICS_H
#define LSM_ACCURACY_EVENT_STATISTICS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Accuracy {

/// Estimate with its standard error.
struct Estimate {
  double value = NAN, error = NAN;
};

/// Mean, with the error of independent samples.
inline Estimate mean(const std::vector<double> &x) {
  double sum = 0.0, squares = 0.0;
  for (double v : x) sum += v;
  const double n = static_cast<double>(x.size()), m = sum / n;
  for (double v : x) squares += (v - m) * (v - m);
  return {m, std::sqrt(squares / (n - 1.0) / n)};
}

/// <s^2> / <s>, the characteristic size, with the error of linear propagation.
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

/// Largest distance of the two cumulative distributions, and the probability of a larger one if
/// both samples come from the same distribution (asymptotic, with Stephens' correction).
struct KolmogorovSmirnov {
  double distance, p;
};
inline KolmogorovSmirnov two_sample(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const double na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  double distance = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == x) ++i;
    while (j < b.size() && b[j] == x) ++j;
    distance =
        std::max(distance, std::fabs(static_cast<double>(i) / na - static_cast<double>(j) / nb));
  }
  const double n = std::sqrt(na * nb / (na + nb)), z = (n + 0.12 + 0.11 / n) * distance;
  double p = 0.0;
  for (int k = 1; k <= 100; ++k) p += (k % 2 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * z * z);
  return {distance, z < 0.2 ? 1.0 : std::clamp(p, 0.0, 1.0)};
}

}  // namespace Accuracy

#endif
