// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite_size.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "lsm_sum.h"
#include "lsm_text_io.h"

namespace LSM::postproc {

namespace {

using text_io::number;

// chi2 + 2 k with the correction for few points (Hurvich & Tsai 1989, Biometrika 76, 297).
double corrected_aic(double chi2, int k, int points) {
  return chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (points - k - 1.0);
}

}  // namespace

SizePoint characteristic_size(const std::vector<double> &sizes, double threshold, double length,
                              int replicas, std::uint64_t seed) {
  const std::string what = "characteristic size: ";
  if (replicas < 2)
    throw std::invalid_argument(what + std::to_string(replicas) + " replicas, expected at least 2");
  if (!(threshold >= 0.0 && std::isfinite(threshold)))
    throw std::invalid_argument(what + "threshold " + number(threshold) +
                                ", expected a finite number of at least 0");
  if (!(length > 0.0 && std::isfinite(length)))
    throw std::invalid_argument(what + "length " + number(length) +
                                ", expected a positive finite number");
  std::vector<double> kept;
  for (double size : sizes)
    if (size > 0.0 && size >= threshold && std::isfinite(size)) kept.push_back(size);
  SizePoint point;
  point.length = length;
  point.n = static_cast<std::int64_t>(kept.size());
  if (point.n < 10) {
    point.why = number(point.n) + " events above the threshold, at least 10 needed";
    return point;
  }
  const auto [least, greatest] = std::minmax_element(kept.begin(), kept.end());
  if (*least == *greatest) {
    point.why = "all events have the same size";
    return point;
  }

  const auto ratio = [&](const auto &next) {
    NeumaierSum sum, squares;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const double size = next(i);
      sum.add(size);
      squares.add(size * size);
    }
    return squares.value() / sum.value();
  };
  point.degenerate = false;
  point.s_star = ratio([&](std::size_t i) { return kept[i]; });
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng(gsl_rng_alloc(gsl_rng_mt19937),
                                                              gsl_rng_free);
  gsl_rng_set(rng.get(), static_cast<unsigned long>(seed));
  NeumaierSum sum, squares;
  for (int replica = 0; replica < replicas; ++replica) {
    const double deviation =
        ratio([&](std::size_t) { return kept[gsl_rng_uniform_int(rng.get(), kept.size())]; }) -
        point.s_star;
    sum.add(deviation);
    squares.add(deviation * deviation);
  }
  const double mean = sum.value() / replicas;
  point.error = std::sqrt((squares.value() - replicas * mean * mean) / (replicas - 1));
  return point;
}

const char *to_string(SizeDependence dependence) {
  switch (dependence) {
    case SizeDependence::power_law:
      return "power law in the length";
    case SizeDependence::none:
      return "no dependence on the length";
    default:
      return "undecided";
  }
}

ScalingFit fit_scaling(const std::vector<SizePoint> &points) {
  std::vector<double> x, y, weight;
  for (const SizePoint &point : points) {
    if (point.degenerate || !(point.error > 0.0)) continue;
    x.push_back(std::log(point.length));
    y.push_back(std::log(point.s_star));
    weight.push_back(std::pow(point.s_star / point.error, 2));
  }
  ScalingFit fit;
  fit.points = static_cast<int>(x.size());
  if (fit.points < 4) {
    fit.why = std::to_string(fit.points) + " usable lengths, at least 4 needed";
    return fit;
  }
  const auto [shortest, longest] = std::minmax_element(x.begin(), x.end());
  if (*longest - *shortest < 1e-9) {
    fit.why = "all models have the same length";
    return fit;
  }
  fit.degenerate = false;
  double log_a = 0.0, variance_a = 0.0, covariance = 0.0, variance_d = 0.0;
  gsl_fit_wlinear(x.data(), 1, weight.data(), 1, y.data(), 1, x.size(), &log_a, &fit.D, &variance_a,
                  &covariance, &variance_d, &fit.chi2);
  fit.A = std::exp(log_a);
  fit.se_A = fit.A * std::sqrt(variance_a);
  fit.se_D = std::sqrt(variance_d);

  double total = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    total += weight[i];
    mean += weight[i] * y[i];
  }
  mean /= total;
  fit.constant = std::exp(mean);
  fit.se_constant = fit.constant / std::sqrt(total);
  fit.chi2_constant = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    fit.chi2_constant += weight[i] * (y[i] - mean) * (y[i] - mean);

  fit.aicc = corrected_aic(fit.chi2, 2, fit.points);
  fit.aicc_constant = corrected_aic(fit.chi2_constant, 1, fit.points);
  if (fit.aicc < fit.aicc_constant - 2.0)
    fit.preferred = SizeDependence::power_law;
  else if (fit.aicc_constant < fit.aicc - 2.0 && std::fabs(fit.D) < 1.96 * fit.se_D)
    fit.preferred = SizeDependence::none;
  return fit;
}

}  // namespace LSM::postproc
