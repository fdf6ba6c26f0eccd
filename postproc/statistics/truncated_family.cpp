// SPDX-License-Identifier: GPL-2.0-or-later
#include "truncated_family.h"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation.h"
#include "gsl_owners.h"

namespace LSM::postproc {

namespace {

// Below this |z| the closed forms suffer from cancellation, while the series are accurate to 1e-11.
constexpr double small_z = 0.1;

// A log-concave density is neglected where it has fallen by this factor (e^-45) from its maximum.
constexpr double log_negligible = 45.0;

// Searches from the mode in one direction for the point beyond which the density is negligible.
double edge_of_support(const std::function<double(double)> &log_density, double mode, double limit,
                       double feature) {
  const double level = log_density(mode) - log_negligible;
  const double sign = limit > mode ? 1.0 : -1.0;
  double inside = mode, step = feature;
  double outside = mode;
  for (;;) {
    outside = mode + sign * step;
    if (sign * (outside - limit) >= 0.0) {
      outside = limit;
      if (log_density(limit) >= level) return limit;
    }
    if (!(log_density(outside) >= level)) break;
    inside = outside;
    step *= 2.0;
  }
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (inside + outside);
    (log_density(middle) >= level ? inside : outside) = middle;
  }
  return outside;
}

}  // namespace

double log_normalisation(double z) {
  if (z > 0.0) return z + log_normalisation(-z);
  return z > -1e-300 ? 0.0 : std::log(std::expm1(z) / z);
}

double tilted_mean(double z) {
  const double z2 = z * z;
  if (std::fabs(z) < small_z) return 0.5 + z * (1.0 / 12.0 - z2 * (1.0 / 720.0 - z2 / 30240.0));
  return -1.0 / std::expm1(-z) - 1.0 / z;
}

double tilted_variance(double z) {
  const double z2 = z * z;
  if (std::fabs(z) < small_z) return 1.0 / 12.0 - z2 * (1.0 / 240.0 - z2 / 6048.0);
  const double s = 2.0 * std::sinh(0.5 * z);
  return 1.0 / z2 - 1.0 / (s * s);
}

namespace {

// The tilt z of a density on [0, 1] with a given mean. In bins of width `step`, the mean is that of
// their centres: a value is the lower edge of its bin plus a part that has the same density within
// the bin, so the mean of the edges is a difference of two means, and likewise the variance.
double tilt_of_mean(double mean, double step) {
  if (mean > 0.5) return -tilt_of_mean(1.0 - mean, step);
  const double edges = mean - 0.5 * step;
  // The tilt of an infinite length, or of a density that is nearly flat.
  const double low = step > 0.0 ? -std::log1p(step / edges) / step : -1.0 / mean;
  const auto likelihood = [=](const Numbers &p) {
    const double z = p[0];
    Likelihood at{z * edges - log_normalisation(z) + log_normalisation(step * z),
                  {edges - tilted_mean(z) + step * tilted_mean(step * z)},
                  SymmetricMatrix(1)};
    at.information(0, 0) = Exponential{1.0, z, step}.variance();
    return at;
  };
  return maximise(likelihood, {mean < 0.25 ? low : std::max(low, 12.0 * (mean - 0.5))}).p[0];
}

}  // namespace

Exponential Exponential::of_mean(double mean, double length, double step) {
  if (std::isfinite(length))
    return {length, tilt_of_mean(mean / length, step / length) / length, step};
  return {length, step > 0.0 ? -std::log1p(step / (mean - 0.5 * step)) / step : -1.0 / mean, step};
}

double Exponential::log_z() const {
  if (finite()) return std::log(length) + log_normalisation(b * length);
  return b < 0.0 ? -std::log(-b) : std::numeric_limits<double>::infinity();
}

double Exponential::variance() const {
  const double whole = finite() ? length * length * tilted_variance(b * length) : 1.0 / (b * b);
  return step > 0.0 ? whole - step * step * tilted_variance(b * step) : whole;
}

double Exponential::cdf(double u) const {
  if (!finite()) return -std::expm1(b * u);
  const double z = b * length;
  if (std::fabs(z) < 1e-12) return u / length;
  if (z < 0.0) return std::expm1(b * u) / std::expm1(z);
  // The same, rearranged to avoid overflow.
  return std::exp(b * (u - length)) * std::expm1(-b * u) / std::expm1(-z);
}

double Exponential::quantile(double probability) const {
  if (!finite()) return std::log1p(-probability) / b;
  const double z = b * length;
  if (std::fabs(z) < 1e-12) return probability * length;
  const double u = z < 0.0 ? std::log1p(probability * std::expm1(z)) / b
                           // Counted from the upper end, where exp(z) does not overflow.
                           : length + std::log1p((probability - 1.0) * -std::expm1(-z)) / b;
  return std::clamp(u, 0.0, length);
}

TabulatedDensity tabulate(const std::function<double(double)> &log_density, double mode,
                          double lower, double upper, double feature) {
  constexpr std::size_t points = 16;
  static const Gsl<gsl_integration_glfixed_table> rule(gsl_integration_glfixed_table_alloc(points),
                                                       gsl_integration_glfixed_table_free);

  if (lower < mode) lower = edge_of_support(log_density, mode, lower, feature);
  if (upper > mode) upper = edge_of_support(log_density, mode, upper, feature);
  const double panels = std::clamp(std::ceil((upper - lower) / feature), 24.0, 20000.0);
  const double width = (upper - lower) / panels;
  const double top = log_density(mode);
  TabulatedDensity table;
  double total = 0.0;
  for (double panel = 0.0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < points; ++i) {
      double u = 0.0, weight = 0.0;
      gsl_integration_glfixed_point(lower + panel * width, lower + (panel + 1.0) * width, i, &u,
                                    &weight, rule.get());
      weight *= std::exp(log_density(u) - top);
      table.u.push_back(u);
      table.p.push_back(weight);
      total += weight;
    }
  }
  for (double &p : table.p) p /= total;
  table.log_z = top + std::log(total);
  return table;
}

TiltedFit fit_tilted(Tilt statistic, double mean_u, double mean_t, double length) {
  // The likelihood is concave: its slope in c at the best exponential shows whether c > 0 is
  // better.
  const double rate = statistic.rate;
  const Exponential law = Exponential::of_mean(mean_u, length);
  TiltedFit fit;
  fit.b = law.b;
  fit.log_likelihood = law.b * mean_u - law.log_z();
  const double expected_t = rate > 0.0
                                ? std::exp(Exponential{length, law.b + rate}.log_z() - law.log_z())
                                : law.variance() + mean_u * mean_u;
  fit.converged = expected_t <= mean_t;
  if (fit.converged) return fit;
  const auto likelihood = [&](const Numbers &p) -> Likelihood {
    const double b = p[0], c = p[1];
    if (!(c > 0.0)) return {};
    double mode = b / (2.0 * c);
    if (rate > 0.0) mode = b > 0.0 ? std::log(b / (c * rate)) / rate : 0.0;
    // The logarithm of the density bends over 1 / rate for T = exp(rate u), and over the standard
    // deviation of the Gaussian for T = u^2.
    const TabulatedDensity table =
        tabulate([&](double u) { return b * u - c * statistic(u); }, std::clamp(mode, 0.0, length),
                 0.0, length, rate > 0.0 ? 1.0 / rate : 1.0 / std::sqrt(2.0 * c));
    const auto [u, t, uu, ut, tt] = table.mean_of([&](double x) -> std::array<double, 5> {
      const double of_x = statistic(x);
      return {x, of_x, x * x, x * of_x, of_x * of_x};
    });
    Likelihood at{
        b * mean_u - c * mean_t - table.log_z, {mean_u - u, t - mean_t}, SymmetricMatrix(2)};
    at.information.entries = {uu - u * u, u * t - ut, u * t - ut, tt - t * t};
    return at;
  };
  const Maximum best = maximise(likelihood, {law.b, 0.1 / mean_t});
  return best.converged ? TiltedFit{best.p[0], best.p[1], best.at.value, true} : fit;
}

}  // namespace LSM::postproc
