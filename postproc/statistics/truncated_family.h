// SPDX-License-Identifier: GPL-2.0-or-later
/// \file truncated_family.h
/// Truncated laws in the variable u = ln(x / lo) on [0, L], the common ground of power_law.h and
/// generalised_gamma.h. There a power law is an exponential, p(u) ~ exp(b u) with b = 1 - alpha,
/// and its rivals are exp(b u - c T(u)) with T = u^2 (log-normal) or T = exp(rate u) (cut-off).
#ifndef LSM_POSTPROC_TRUNCATED_FAMILY_H
#define LSM_POSTPROC_TRUNCATED_FAMILY_H

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace LSM::postproc {

// The density proportional to exp(z t) for t in [0, 1]; accurate for every z including 0.
double log_normalisation(double z);  ///< ln((exp(z) - 1) / z)
double tilted_mean(double z);        ///< rises from 0 (z = -infinity) to 1
double tilted_variance(double z);    ///< derivative of tilted_mean
double tilt_of_mean(double mean);    ///< inverse of tilted_mean, 0 < mean < 1

/// The density proportional to exp(b u) for u in [0, length]; b < 0 if length is infinite.
struct Exponential {
  double length, b;

  /// Maximum likelihood for a sample of that mean, 0 < mean < length.
  static Exponential of_mean(double mean, double length);
  bool finite() const { return std::isfinite(length); }
  double log_z() const;  ///< ln of the integral of exp(b u); infinite if there is none
  double variance() const;
  double cdf(double u) const;
  double quantile(double probability) const;  ///< 0 <= probability < 1
};

/// Abscissae and probabilities that stand for a density: integrals become sums.
struct TabulatedDensity {
  std::vector<double> u, p;  ///< p sums to 1
  double log_z = 0.0;        ///< ln of the integral of exp(log_density)

  template <class F>
  double mean(F f) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) sum += p[i] * f(u[i]);
    return sum;
  }
};

/// Gauss-Legendre table of a log-concave density on [lower, upper], either may be infinite; mode is
/// its maximum inside; feature: shortest length on which the logarithm of the density bends. It
/// asks for the density at its abscissae last, in their order.
TabulatedDensity tabulate(const std::function<double(double)> &log_density, double mode,
                          double lower, double upper, double feature);

/// T(u) = u^2, or exp(rate u) if rate > 0.
struct Statistic {
  double rate = 0.0;
  double operator()(double u) const { return rate > 0.0 ? std::exp(rate * u) : u * u; }
};

/// Maximum likelihood of p(u) ~ exp(b u - c T(u)) on [0, length], length may be infinite, c >= 0.
struct TiltedFit {
  double b = 0.0, c = 0.0;      ///< c 0: best at the border, where the law is an exponential in u
  double log_likelihood = 0.0;  ///< per event, density in u
  bool converged = false;
};

/// mean_u and mean_t are the means of u and T(u) over the sample (a sufficient statistic).
TiltedFit fit_tilted(Statistic statistic, double mean_u, double mean_t, double length);

}  // namespace LSM::postproc

#endif
