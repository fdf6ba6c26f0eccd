// SPDX-License-Identifier: GPL-2.0-or-later
/// \file truncated_family.h
/// Truncated distributions of u = ln(x / lo) on [0, L], shared by power_law.h and
/// generalised_gamma.h. In this variable a power law is an exponential, p(u) ~ exp(b u) with b =
/// 1 - alpha, and its rivals are exp(b u - c T(u)) with T = u^2 (log-normal) or T = exp(rate u)
/// (cut-off).
#ifndef LSM_POSTPROC_TRUNCATED_FAMILY_H
#define LSM_POSTPROC_TRUNCATED_FAMILY_H

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace LSM::postproc {

// Properties of the density proportional to exp(z t) for t in [0, 1], accurate for all z, also 0.
double log_normalisation(double z);  ///< ln((exp(z) - 1) / z)
double tilted_mean(double z);        ///< increases from 0 (z = -infinity) to 1
double tilted_variance(double z);    ///< derivative of tilted_mean

/// Density proportional to exp(b u) for u in [0, length]; b < 0 if length is infinite.
struct Exponential {
  double length, b;
  /// Width of the bins in which values were counted, a whole number of which fills the length; 0:
  /// the values themselves are known.
  double step = 0.0;

  /// Maximum-likelihood fit to a sample with this mean (in bins: of their centres), step / 2 < mean
  /// < length - step / 2. In bins it is that of the integrals of the density over them, which are a
  /// geometric series.
  static Exponential of_mean(double mean, double length, double step = 0.0);
  bool finite() const { return std::isfinite(length); }
  /// Logarithm of the integral of exp(b u); infinite if the integral diverges.
  double log_z() const;
  double variance() const;  ///< of a value, in bins of their centres: Fisher's information about b
  double cdf(double u) const;
  double quantile(double probability) const;  ///< 0 <= probability < 1
};

/// Abscissae and probabilities that represent a density, so that integrals become sums.
struct TabulatedDensity {
  std::vector<double> u, p;  ///< p sums to 1
  double log_z = 0.0;        ///< logarithm of the integral of exp(log_density)

  /// Means of several functions, which f returns as an array.
  template <class F>
  auto mean_of(F f) const {
    auto sums = f(0.0);
    sums.fill(0.0);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto terms = f(u[i]);
      for (std::size_t k = 0; k < terms.size(); ++k) sums[k] += p[i] * terms[k];
    }
    return sums;
  }
};

/// Gauss-Legendre table of a log-concave density.
/// \param log_density its logarithm up to a constant
/// \param mode maximum of the density within the limits
/// \param lower, upper limits; either may be infinite
/// \param feature shortest length over which the logarithm of the density bends
TabulatedDensity tabulate(const std::function<double(double)> &log_density, double mode,
                          double lower, double upper, double feature);

/// T(u) = u^2, or exp(rate u) if rate > 0.
struct Tilt {
  double rate = 0.0;
  double operator()(double u) const { return rate > 0.0 ? std::exp(rate * u) : u * u; }
};

/// Fit of p(u) ~ exp(b u - c T(u)) on [0, length] with c >= 0.
struct TiltedFit {
  /// c = 0: the best value is on the boundary, where the law is an exponential in u.
  double b = 0.0, c = 0.0;
  double log_likelihood = 0.0;  ///< per event, for the density in u
  bool converged = false;
};

/// Maximum-likelihood fit.
/// \param mean_u, mean_t means of u and T(u) over the sample, which are sufficient statistics
/// \param length may be infinite
TiltedFit fit_tilted(Tilt statistic, double mean_u, double mean_t, double length);

}  // namespace LSM::postproc

#endif
