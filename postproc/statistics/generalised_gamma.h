// SPDX-License-Identifier: GPL-2.0-or-later
/// \file generalised_gamma.h
/// Generalised gamma density f(theta) = C theta^(gamma-1) exp(-theta^delta / B) of inter-event
/// times (paper Eq. 9, after Corral 2004, Phys. Rev. Lett. 92, 108501).
#ifndef LSM_POSTPROC_GENERALISED_GAMMA_H
#define LSM_POSTPROC_GENERALISED_GAMMA_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "log_histogram.h"

namespace LSM::postproc {

/// Fit of a generalised gamma density.
struct GeneralisedGammaFit {
  /// Parameters, NaN like their standard errors if the fit is degenerate. B has the unit of
  /// theta^delta, C that of theta^-gamma.
  double C = NAN, gamma = NAN, delta = NAN, B = NAN;
  /// Standard errors; that of delta is 0 if delta was held.
  double se_C = NAN, se_gamma = NAN, se_delta = NAN, se_B = NAN;
  bool delta_fixed = false;
  double lo = 0.0;     ///< left truncation (maximum likelihood) or lowest edge (least squares)
  std::int64_t n = 0;  ///< number of values, or of counts in the bins used
  double log_likelihood = NAN;  ///< maximum likelihood only; also of the optimum of no valid fit
  /// Kolmogorov-Smirnov distance, maximum likelihood only. It is reduced by fitting the parameters
  /// to the same values, so tables for given parameters do not apply; see p_value().
  double ks = NAN;
  double chi2 = NAN;       ///< least squares only
  int dof = 0;             ///< least squares: bins used minus free parameters
  bool degenerate = true;  ///< the data do not determine the parameters: do not show them
  std::string why;         ///< reason, one line
};

/// Weighted least squares on the logarithm of a log-binned density with C free, as the paper did †
/// (weights equal to the counts, which are 1 / Poisson variance of the logarithm; half a count
/// taken off for the bias of the logarithm; the model averaged over each bin). Standard errors are
/// multiplied by sqrt(chi2 / dof) where that exceeds 1. Bins with fewer than 5 counts are left out,
/// since their logarithms are biased. As sparse bins pass this limit more often when they fluctuate
/// upwards, gamma is too low by up to one standard error for fewer than about 1000 values: prefer
/// maximum likelihood.
/// \param delta value at which delta is held; NaN: free
/// \throws std::invalid_argument for delta outside 0.1 to 10
GeneralisedGammaFit fit_least_squares(const std::vector<LogBin> &bins, double delta = NAN);

/// Maximum likelihood with C from normalisation over [lo, infinity); standard errors come from the
/// observed information. gamma <= 0 (the block-slider's value in Table 1 is 0) can only be
/// normalised, and so fitted, with lo > 0.
///
/// Both fits are degenerate if there are too few data; if there is no fall-off inside the data (not
/// better than a pure power law at 95 %; not tested with lo = 0, where a power law is no density);
/// if delta is outside 0.1 to 10; if the information matrix is singular (reciprocal condition
/// number below 1e-10 after scaling); or if the parameters are too strongly correlated: a standard
/// error above 0.25 max(1, |gamma|) of gamma, above 0.25 of ln delta, or above 1 of ln B (which
/// depends on the unit of time: a poorly determined delta affects B less if times are divided by
/// their mean).
///
/// \param lo left truncation; smaller values are not used
/// \param delta value at which delta is held; NaN: free
/// \throws std::invalid_argument for delta outside 0.1 to 10, or for values that are not finite or,
/// with lo = 0, not positive
GeneralisedGammaFit fit_maximum_likelihood(const std::vector<double> &values, double lo = 0.0,
                                           double delta = NAN);

/// Probability of a fit as poor as this one if the values are independent draws from the fitted
/// density. Least squares: from chi2 and dof, without random numbers. Maximum likelihood: the
/// fraction of synthetic samples, each fitted as the data were, whose Kolmogorov-Smirnov distance
/// is at least that of the data, (k + 1) / (replicas + 1); its standard error is sqrt(p (1 - p) /
/// replicas).
/// \param values the values that were fitted
/// \param replicas number of synthetic samples
/// \return NaN for maximum likelihood without replicas
/// \throws std::invalid_argument if the fit is degenerate
double p_value(const GeneralisedGammaFit &fit, const std::vector<double> &values, int replicas,
               std::uint64_t seed);

}  // namespace LSM::postproc

#endif
