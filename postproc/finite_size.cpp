// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite_size.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>
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

// Usable points: logarithms of length and s*, weights of the latter.
struct LogPoints {
  std::vector<double> x, y, weight;
};

// Parameters ln s_inf, ln L_c, D. Either array may be null.
int saturating(const gsl_vector *p, const LogPoints &points, gsl_vector *residuals,
               gsl_matrix *jacobian) {
  const double a = gsl_vector_get(p, 0), c = gsl_vector_get(p, 1), D = gsl_vector_get(p, 2);
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double below = c - points.x[i], z = Saturation::sharpness * D * below;
    if (!std::isfinite(z)) return GSL_EDOM;
    const double small = std::exp(-std::fabs(z));  // ln(1 + e^z) without overflow
    if (residuals)
      gsl_vector_set(
          residuals, i,
          a - (std::max(z, 0.0) + std::log1p(small)) / Saturation::sharpness - points.y[i]);
    if (!jacobian) continue;
    const double share = (z > 0.0 ? 1.0 : small) / (1.0 + small);
    gsl_matrix_set(jacobian, i, 0, 1.0);
    gsl_matrix_set(jacobian, i, 1, -share * D);
    gsl_matrix_set(jacobian, i, 2, -share * below);
  }
  return GSL_SUCCESS;
}

Saturation fit_saturation(LogPoints points) {
  Saturation fit;
  const std::size_t n = points.x.size();
  if (n < 5) {
    fit.why = std::to_string(n) + " usable points, at least 5 needed";
    return fit;
  }
  std::vector<double> steps = points.x;
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end(),
                          [](double one, double next) { return next - one < 1e-9; }),
              steps.end());
  if (steps.size() < 4) {
    fit.why = std::to_string(steps.size()) + " different lengths, at least 4 needed";
    return fit;
  }

  gsl_error_handler_t *const handler = gsl_set_error_handler_off();
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, 3),
      gsl_multifit_nlinear_free);
  gsl_multifit_nlinear_fdf functions{};
  functions.f = [](const gsl_vector *p, void *data, gsl_vector *f) {
    return saturating(p, *static_cast<const LogPoints *>(data), f, nullptr);
  };
  functions.df = [](const gsl_vector *p, void *data, gsl_matrix *j) {
    return saturating(p, *static_cast<const LogPoints *>(data), nullptr, j);
  };
  functions.n = n;
  functions.p = 3;
  functions.params = &points;
  const gsl_vector_const_view weights = gsl_vector_const_view_array(points.weight.data(), n);
  double best[3] = {}, covariance[9] = {};
  gsl_matrix_view covariances = gsl_matrix_view_array(covariance, 3, 3);
  bool converged = false;
  fit.chi2 = HUGE_VAL;
  // From a sharp bend at each length inside, as chi2 may have several minima.
  for (std::size_t start = 1; start + 1 < steps.size(); ++start) {
    std::vector<double> bent = points.x;
    for (double &x : bent) x = std::min(x - steps[start], 0.0);
    double p[3] = {0.0, steps[start], 0.0}, unused[4];
    gsl_fit_wlinear(bent.data(), 1, points.weight.data(), 1, points.y.data(), 1, n, &p[0], &p[2],
                    &unused[0], &unused[1], &unused[2], &unused[3]);
    const gsl_vector_const_view first = gsl_vector_const_view_array(p, 3);
    if (gsl_multifit_nlinear_winit(&first.vector, &weights.vector, &functions, work.get()) !=
        GSL_SUCCESS)
      continue;
    int info = 0;
    const int status =
        gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0.0, nullptr, nullptr, &info, work.get());
    const gsl_vector *const f = gsl_multifit_nlinear_residual(work.get());
    double chi2 = HUGE_VAL;
    gsl_blas_ddot(f, f, &chi2);
    if (!(chi2 < fit.chi2)) continue;
    fit.chi2 = chi2;
    for (std::size_t i = 0; i < 3; ++i)
      best[i] = gsl_vector_get(gsl_multifit_nlinear_position(work.get()), i);
    // Without progress: the residuals cannot fall further within rounding.
    converged = (status == GSL_SUCCESS || status == GSL_ENOPROG) &&
                gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0.0,
                                           &covariances.matrix) == GSL_SUCCESS;
  }
  gsl_set_error_handler(handler);

  fit.aicc = corrected_aic(fit.chi2, 3, static_cast<int>(n));
  if (!std::isfinite(fit.chi2) || !(best[1] > steps[1] && best[1] < steps[steps.size() - 2]))
    fit.why = "no end of growth with two lengths on either side of it";
  else if (!converged)
    fit.why = "no minimum of chi2";
  else if (!(best[2] > 1.96 * std::sqrt(covariance[8])))
    fit.why = "no significant growth up to where it would end";
  if (!fit.why.empty()) {
    fit.chi2 = fit.aicc = fit.D;
    return fit;
  }
  fit.degenerate = false;
  fit.s_inf = std::exp(best[0]);
  fit.se_s_inf = fit.s_inf * std::sqrt(covariance[0]);
  fit.L_c = std::exp(best[1]);
  fit.se_L_c = fit.L_c * std::sqrt(covariance[4]);
  fit.D = best[2];
  fit.se_D = std::sqrt(covariance[8]);
  return fit;
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
    case SizeDependence::saturates:
      return "growth that ends at a length";
    default:
      return "undecided";
  }
}

ScalingFit fit_scaling(const std::vector<SizePoint> &points) {
  LogPoints usable;
  auto &[x, y, weight] = usable;
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
  fit.saturation = fit_saturation(usable);
  if (fit.saturation.aicc < std::min(fit.aicc, fit.aicc_constant) - 2.0)
    fit.preferred = SizeDependence::saturates;
  else if (fit.aicc < fit.aicc_constant - 2.0)
    fit.preferred = SizeDependence::power_law;
  else if (fit.aicc_constant < fit.aicc - 2.0 && std::fabs(fit.D) < 1.96 * fit.se_D)
    fit.preferred = SizeDependence::none;
  return fit;
}

}  // namespace LSM::postproc
