// SPDX-License-Identifier: GPL-2.0-or-later
#include "truncated_family.h"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <limits>

#include "gsl_owners.h"

namespace LSM::postproc {

namespace {

// Below this |z| the closed forms cancel and the series are exact to 1e-11.
constexpr double small_z = 0.1;

// Where a log-concave density has fallen by this factor (e^-45) the rest does not count.
constexpr double log_negligible = 45.0;

// Walks from the mode in one direction to where the density is negligible.
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

double tilt_of_mean(double mean) {
  if (mean > 0.5) return -tilt_of_mean(1.0 - mean);
  // The mean lies below that of the untruncated exponential, -1/z: the root is in [-1/mean, 0].
  double low = -1.0 / mean, high = 0.0;
  double z = mean < 0.25 ? low : std::max(low, 12.0 * (mean - 0.5));
  for (int i = 0; i < 100; ++i) {
    const double excess = tilted_mean(z) - mean;
    (excess > 0.0 ? high : low) = z;
    double next = z - excess / tilted_variance(z);
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::fabs(next - z) <= 4e-16 * std::fabs(z)) break;
    z = next;
  }
  return z;
}

TabulatedDensity tabulate(const std::function<double(double)> &log_density, double mode,
                          double lower, double upper, double feature) {
  constexpr std::size_t points = 16;
  static const Gsl<gsl_integration_glfixed_table> rule(gsl_integration_glfixed_table_alloc(points),
                                                       gsl_integration_glfixed_table_free);

  if (lower < mode) lower = edge_of_support(log_density, mode, lower, feature);
  if (upper > mode) upper = edge_of_support(log_density, mode, upper, feature);
  const double panels = std::clamp(std::ceil((upper - lower) / feature), 64.0, 20000.0);
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

TiltedFit fit_tilted(Statistic statistic, double mean_u, double mean_t, double length) {
  const bool finite = std::isfinite(length);
  const double rate = statistic.rate;
  TiltedFit fit;

  // The likelihood is concave, so its slope in c at the best exponential shows whether c > 0 helps.
  const double z = finite ? tilt_of_mean(mean_u / length) : 0.0;
  fit.b = finite ? z / length : -1.0 / mean_u;
  const double log_z0 = finite ? std::log(length) + log_normalisation(z) : -std::log(-fit.b);
  fit.log_likelihood = fit.b * mean_u - log_z0;
  double expected_t = 0.0;
  if (rate > 0.0) {
    if (finite)
      expected_t = std::exp(log_normalisation(z + rate * length) - log_normalisation(z));
    else
      expected_t = rate < -fit.b ? fit.b / (fit.b + rate) : std::numeric_limits<double>::infinity();
  } else {
    expected_t = mean_u * mean_u * 2.0;
    if (finite) {
      const double m = tilted_mean(z);
      expected_t = length * length * (tilted_variance(z) + m * m);
    }
  }
  if (expected_t <= mean_t) {
    fit.border = fit.converged = true;
    return fit;
  }

  const auto table_at = [&](double b, double c) {
    double mode = 0.0;
    if (rate > 0.0)
      mode = b > 0.0 ? std::log(b / (c * rate)) / rate : 0.0;
    else
      mode = b / (2.0 * c);
    mode = std::clamp(mode, 0.0, length);
    // Bends: of u^2 c over its own standard deviation, of exp(rate u) over 1 / rate.
    const double feature = rate > 0.0 ? 1.0 / rate : 1.0 / std::sqrt(2.0 * c);
    return tabulate([&](double u) { return b * u - c * statistic(u); }, mode, 0.0, length, feature);
  };

  double b = fit.b, c = 0.1 / mean_t;
  TabulatedDensity table = table_at(b, c);
  double value = b * mean_u - c * mean_t - table.log_z;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double m_u = table.mean([](double u) { return u; });
    const double m_t = table.mean(statistic);
    double uu = 0.0, ut = 0.0, tt = 0.0;
    for (std::size_t i = 0; i < table.u.size(); ++i) {
      const double du = table.u[i] - m_u, dt = statistic(table.u[i]) - m_t;
      uu += table.p[i] * du * du;
      ut += table.p[i] * du * dt;
      tt += table.p[i] * dt * dt;
    }
    // Newton's step for the slopes g of the log-likelihood per event; its Hessian is minus the
    // covariance of (u, -T).
    const double g_b = mean_u - m_u, g_c = m_t - mean_t;
    const double determinant = uu * tt - ut * ut;
    if (!(determinant > 0.0)) return fit;
    double step_b = (g_b * tt + g_c * ut) / determinant;
    double step_c = (g_c * uu + g_b * ut) / determinant;
    const double gain = g_b * step_b + g_c * step_c;
    if (gain < 1e-20) {
      fit.b = b;
      fit.c = c;
      fit.log_likelihood = value;
      fit.converged = true;
      return fit;
    }
    // c stays positive; halve until the likelihood rises.
    double scale = c + step_c > 0.1 * c ? 1.0 : -0.9 * c / step_c;
    for (;; scale *= 0.5) {
      if (scale < 1e-12) return fit;
      TabulatedDensity trial = table_at(b + scale * step_b, c + scale * step_c);
      const double trial_value =
          (b + scale * step_b) * mean_u - (c + scale * step_c) * mean_t - trial.log_z;
      // Near the optimum the gain is below rounding, so equality up to that is a success.
      if (trial_value > value - 1e-14 * (1.0 + std::fabs(value))) {
        b += scale * step_b;
        c += scale * step_c;
        value = trial_value;
        table = std::move(trial);
        break;
      }
    }
  }
  return fit;
}

}  // namespace LSM::postproc
