// SPDX-License-Identifier: GPL-2.0-or-later
/// \file power_law.h
/// Exponents of power laws by maximum likelihood: density C x^-alpha on [lo, hi], with any real
/// alpha if hi is finite (Deluca & Corral 2013) and alpha > 1 if hi is infinite (Clauset, Shalizi &
/// Newman 2009). All functions take the sample in ascending order and do not use values outside
/// [lo, hi].
///
/// Sizes of earthquakes come from magnitudes that agencies round, to 0.1 or 0.01, so that their
/// logarithms are multiples of a step. With a step > 0, values are counted in bins centred at these
/// multiples; [lo, hi] holds the bins whose centres lie in it, the law extends half a bin beyond
/// the first and the last of them, and likelihoods, distances (at the edges of bins) and replicas
/// are those of the counts †. Taken for continuous, such sizes give too steep a law.
///
/// The paper (Sect. 4.2) fitted its exponents to binned densities by an unstated method;
/// maximum likelihood is †.
///
/// Sources: Clauset, Shalizi & Newman 2009, SIAM Review 51, 661 (Monte Carlo p-value,
/// likelihood ratios); Deluca & Corral 2013, Acta Geophysica 61,
/// 1351 (double truncation); Vuong 1989, Econometrica 57, 307; Alstott, Bullmore & Plenz 2014, PLoS
/// ONE 9, e85777 (Python package powerlaw: same comparisons, one-sided range).
#ifndef LSM_POSTPROC_POWER_LAW_H
#define LSM_POSTPROC_POWER_LAW_H

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace LSM::postproc {

/// Fit of a power law on one range.
struct PowerLawFit {
  double alpha = NAN;
  double standard_error = NAN;  ///< from the Fisher information
  double lo = 0.0, hi = 0.0;    ///< range of the fit; hi may be infinite
  std::int64_t n = 0;           ///< events in [lo, hi]
  double ks = NAN;              ///< Kolmogorov-Smirnov distance
  double log_likelihood = NAN;
  double step = 0.0;       ///< of ln(size) between bins; lo and hi are centres of bins; 0: no bins
  bool degenerate = true;  ///< no usable exponent: alpha, error, ks, likelihood are NaN
  std::string why;         ///< reason, one line

  /// Ends of the law: lo and hi, in bins the outer edges of the first and the last one.
  double lower_end() const { return lo * std::exp(-0.5 * step); }
  double upper_end() const { return hi * std::exp(0.5 * step); }
};

/// Fits the exponent on a given range. The fit is degenerate if fewer than 10 events are in the
/// range, if all are equal or at one edge, or if the range does not determine the exponent
/// (standard error above both 1 and |alpha - 1|).
/// \throws std::invalid_argument unless the sample is ascending and 0 < lo < hi, with lo finite
PowerLawFit fit_power_law(const std::vector<double> &sorted, double lo,
                          double hi = std::numeric_limits<double>::infinity(), double step = 0.0);

/// Monte Carlo p-value: fraction of synthetic samples that fit as poorly (whose Kolmogorov-Smirnov
/// distance is at least that of the data), (k + 1) / (replicas + 1), see monte_carlo.h. A small p
/// (Clauset et al.: below 0.1) rejects the power law. Its standard error is sqrt(p (1 - p) /
/// replicas).
/// \throws std::invalid_argument if the fit is degenerate
double p_value(const PowerLawFit &fit, const std::vector<double> &sorted, int replicas,
               std::uint64_t seed);

/// Comparison with another law, fitted to the same events on the same range.
struct Comparison {
  std::string rival;  ///< "exponential", "log-normal" or "power law with exponential cut-off"
  std::vector<std::pair<std::string, double>> parameters;  ///< name, value; empty if degenerate
  double log_likelihood_ratio = 0.0;  ///< ln L(power law) - ln L(rival); > 0 favours the power law
  /// Vuong's statistic, ratio / (sqrt(n) standard deviation); for the cut-off, 2 x ratio.
  double normalised = 0.0;
  /// Two-sided p-value (Vuong). The power law is a special case of the cut-off; there, p is from
  /// chi square with 1 degree of freedom, which is conservative since the cut-off cannot be
  /// negative.
  double p = 1.0;
  /// The best rival is its limit (a power law, or a flat density), or sizes are in bins.
  bool degenerate = false;
  std::string why = {};
};

/// Compares the power law with an exponential, a log-normal and a power law with exponential
/// cut-off, all truncated to [fit.lo, fit.hi].
/// \throws std::invalid_argument if the fit is degenerate
std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit);

}  // namespace LSM::postproc

#endif
