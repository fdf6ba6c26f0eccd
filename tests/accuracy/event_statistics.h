// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_statistics.h
/// Summary statistics of event sizes and times, and tests of whether samples agree.
#ifndef LSM_ACCURACY_EVENT_STATISTICS_H
#define LSM_ACCURACY_EVENT_STATISTICS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <utility>
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

/// Largest distance between two cumulative distributions, and the probability of a larger one if
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

/// Derivatives of log Gamma: digamma, trigamma (x > 0).
inline std::pair<double, double> polygamma(double x) {
  double first = 0.0, second = 0.0;
  for (; x < 10.0; x += 1.0) {
    first -= 1.0 / x;
    second += 1.0 / (x * x);
  }
  const double q = 1.0 / (x * x);
  first += std::log(x) - 0.5 / x - q * (1.0 / 12.0 - q * (1.0 / 120.0 - q / 252.0));
  second += 1.0 / x + 0.5 * q + q / x * (1.0 / 6.0 - q * (1.0 / 30.0 - q / 42.0));
  return {first, second};
}

/// Fit of a density ~ t^(gamma - 1) exp(-t / b) to times by maximum likelihood; NaN with fewer than
/// 10 times.
struct GammaDensity {
  Estimate gamma, b;
};
inline GammaDensity gamma_density(const std::vector<double> &t) {
  const double n = static_cast<double>(t.size());
  if (n < 10.0) return {};
  double sum = 0.0, logs = 0.0;
  for (double v : t) {
    if (!(v > 0.0)) throw std::runtime_error("gamma_density: a time is not above 0");
    sum += v;
    logs += std::log(v);
  }
  const double mean = sum / n, spread = std::log(mean) - logs / n;
  // log(gamma) - digamma(gamma) = spread; the left side falls with gamma
  double low = 1e-6, high = 1e6;
  for (int k = 0; k < 200; ++k) {
    const double mid = std::sqrt(low * high);
    (std::log(mid) - polygamma(mid).first > spread ? low : high) = mid;
  }
  const double gamma = std::sqrt(low * high), second = polygamma(gamma).second, b = mean / gamma;
  return {{gamma, std::sqrt(gamma / (n * (gamma * second - 1.0)))},
          {b, b * std::sqrt(second / (n * (gamma * second - 1.0)))}};
}

/// Probability that chi-square with the given degrees of freedom exceeds x.
inline double chi_square_tail(double x, int freedom) {
  if (freedom < 1 || !(x >= 0.0)) throw std::runtime_error("chi_square_tail: out of range");
  const double half = 0.5 * x;
  double a = freedom % 2 ? 0.5 : 1.0;
  double tail = freedom % 2 ? std::erfc(std::sqrt(half)) : std::exp(-half);
  double term = std::pow(half, a) * std::exp(-half) / std::tgamma(a + 1.0);
  for (; a < 0.5 * freedom; a += 1.0) {
    tail += term;
    term *= half / (a + 1.0);
  }
  return tail;
}

/// Do estimates from several time steps agree? If all have the same true value, p_same is the
/// probability of a larger scatter (chi-square), and p_trend that of a larger slope against the
/// time step. Both are 1 with fewer than two estimates or time steps.
struct Agreement {
  double p_same = 1.0, p_trend = 1.0;
};
inline Agreement agreement(const std::vector<double> &dt, const std::vector<Estimate> &all) {
  double w = 0.0, wx = 0.0, wy = 0.0;
  int n = 0;
  auto known = [](const Estimate &e) { return std::isfinite(e.value) && e.error > 0.0; };
  for (std::size_t k = 0; k < all.size(); ++k)
    if (known(all[k])) {
      const double g = 1.0 / (all[k].error * all[k].error);
      w += g;
      wx += g * dt[k];
      wy += g * all[k].value;
      ++n;
    }
  if (n < 2) return {};
  double chi = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (known(all[k])) {
      const double g = 1.0 / (all[k].error * all[k].error), x = dt[k] - wx / w,
                   y = all[k].value - wy / w;
      chi += g * y * y;
      xx += g * x * x;
      xy += g * x * y;
    }
  return {chi_square_tail(chi, n - 1), xx > 0.0 ? chi_square_tail(xy * xy / xx, 1) : 1.0};
}

/// Events of two runs, paired one to one by their starts (both in order of time).
struct Pairs {
  int both = 0, only_first = 0, only_second = 0;
  /// Probability of a larger difference between the two numbers if an event is equally likely to be
  /// missing in either run (McNemar's test with correction for continuity).
  double p() const {
    const double off = std::abs(only_first - only_second), all = only_first + only_second;
    return off > 1.0 ? chi_square_tail((off - 1.0) * (off - 1.0) / all, 1) : 1.0;
  }
};
/// Pairs the events of two runs.
/// \param near largest distance between the two starts of a pair
inline Pairs paired(const std::vector<double> &first, const std::vector<double> &second,
                    double near) {
  Pairs pairs;
  std::size_t i = 0, j = 0;
  while (i < first.size() && j < second.size()) {
    if (std::fabs(first[i] - second[j]) <= near) {
      ++pairs.both;
      ++i;
      ++j;
    } else {
      ++(first[i] < second[j] ? i : j);
    }
  }
  pairs.only_first = static_cast<int>(first.size()) - pairs.both;
  pairs.only_second = static_cast<int>(second.size()) - pairs.both;
  return pairs;
}

}  // namespace Accuracy

#endif
