// SPDX-License-Identifier: GPL-2.0-or-later
/// \file power_law.h
/// Exponents of power laws by maximum likelihood: density C x^-alpha on [lo, hi], any real alpha if
/// hi is finite (Deluca & Corral 2013), alpha > 1 if hi is infinite (Clauset, Shalizi & Newman
/// 2009). All functions take the sample in ascending order; values outside [lo, hi] are not used.
/// The paper (Sect. 4.2) fitted its exponents to binned densities by an unstated method; maximum
/// likelihood is †.
///
/// Sources: Clauset, Shalizi & Newman 2009, SIAM Review 51, 661 (range by Kolmogorov-Smirnov
/// distance, Monte Carlo p-value, likelihood ratios); Deluca & Corral 2013, Acta Geophysica 61,
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

struct PowerLawFit {
  double alpha = NAN;
  double standard_error = NAN;  ///< Fisher information
  double lo = 0.0, hi = 0.0;    ///< the range, hi may be infinite
  std::int64_t n = 0;           ///< events in [lo, hi]
  double ks = NAN;              ///< Kolmogorov-Smirnov distance
  double log_likelihood = NAN;
  bool searched = false;   ///< the range comes from search_range()
  double least = 0.0;      ///< and was to begin there or above
  bool degenerate = true;  ///< no usable exponent: alpha, error, ks, likelihood are NaN
  std::string why;         ///< reason, one line
};

/// Exponent on a given range. Degenerate: fewer than 10 events in the range, all equal, all on one
/// edge, or an exponent that the range does not determine (standard error above both 1 and
/// |alpha - 1|). \throws std::invalid_argument if not ascending, or not 0 < lo < hi
PowerLawFit fit_power_law(const std::vector<double> &sorted, double lo,
                          double hi = std::numeric_limits<double>::infinity());

/// The range whose fit has the smallest Kolmogorov-Smirnov distance, of those that hold at least 50
/// events over a ratio of 10: over all pairs of candidates † (after Deluca & Corral; Clauset et
/// al. search the lower cut). These are 60, evenly spaced in log x between the extremes of the
/// sample (instead of every value, which costs the square of n). The standard error does not
/// include the choice of range. \param least smaller values are left out; 0 or less: those above 0
PowerLawFit search_range(const std::vector<double> &sorted, double least = 0.0);

/// Fraction of synthetic samples that fit worse (by Kolmogorov-Smirnov distance) than the data,
/// (k + 1) / (replicas + 1). Each replica is fitted as the data were: with a given range the
/// exponent, with a searched one the range too; there, what lies outside the range is resampled
/// from the data. Small (Clauset et al.: below 0.1) means: not a power law. Standard error sqrt(p
/// (1 - p) / replicas). \throws std::invalid_argument if the fit is degenerate
double p_value(const PowerLawFit &fit, const std::vector<double> &sorted, int replicas,
               std::uint64_t seed);

/// Another law fitted to the same events on the same range.
struct Comparison {
  std::string rival;  ///< "exponential", "log-normal" or "power law with exponential cut-off"
  std::vector<std::pair<std::string, double>> parameters;  ///< name, value; empty if degenerate
  double log_likelihood_ratio = 0.0;  ///< ln L(power law) - ln L(rival); > 0 favours the power law
  double normalised = 0.0;  ///< ratio / (sqrt(n) standard deviation) (Vuong); cut-off: 2 x ratio
  double p = 1.0;  ///< two-sided (Vuong); cut-off, of which the power law is a case: chi square
                   ///< with 1 degree of freedom, which is conservative since it cannot be negative
  bool degenerate = false;  ///< the best rival is its limit (a power law, or a flat density)
  std::string why = {};
};

/// Compares with an exponential, a log-normal and a power law with exponential cut-off, all
/// truncated to [fit.lo, fit.hi]. \throws std::invalid_argument if the fit is degenerate
std::vector<Comparison> compare(const std::vector<double> &sorted, const PowerLawFit &fit);

}  // namespace LSM::postproc

#endif
