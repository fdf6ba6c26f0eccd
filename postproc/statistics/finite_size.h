// SPDX-License-Identifier: GPL-2.0-or-later
/// \file finite_size.h
/// Whether the roll-off of the event sizes moves with the length of the fault. The paper (Sect.
/// 4.2) suspects a finite-size effect and leaves the question open; this test is †.
#ifndef LSM_POSTPROC_FINITE_SIZE_H
#define LSM_POSTPROC_FINITE_SIZE_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Characteristic size of the events of one model.
struct SizePoint {
  double length = 0.0;  ///< fault length (model units) or number of blocks
  double s_star = NAN;  ///< <s^2> / <s>, energy units
  double error = NAN;   ///< bootstrap standard error
  /// Standard error that independent events would have, from their moments.
  double error_independent = NAN;
  double block = 0.0;      ///< length of the bootstrap blocks (model time); 0: single events
  int blocks = 0;          ///< number of blocks that make up the catalogue
  std::int64_t n = 0;      ///< events at or above the threshold
  bool degenerate = true;  ///< fewer than 10 events or all equal: s_star and error are NaN
  std::string why;
};

/// How the error is estimated by resampling one catalogue.
struct Resampling {
  int replicas = 200;
  std::uint64_t seed = 1;
  /// Length of the blocks (model time); NaN: block_length(); 0: events are resampled one by one, as
  /// if they were independent.
  double block = NAN;
};

/// Characteristic size s* = <s^2> / <s> of the sizes at or above the threshold; for a power law
/// with exponent below 3 it follows the roll-off. As events cluster, the standard error comes from
/// a circular block bootstrap in time (Politis & Romano 1992): the catalogue is closed to a ring,
/// from which stretches that begin at random times are drawn until they are as long as the
/// catalogue. Resampling single events would ignore the correlation of neighbouring ones.
/// \param t_start start times of the events in ascending order (model time)
/// \param sizes sizes of the same events (energy)
/// \param threshold smallest size that is used (energy)
/// \param length of the fault (model units), or number of blocks; stored in the result only
/// \throws std::invalid_argument for a block longer than half the catalogue or shorter than a
/// hundredth of the mean interval
SizePoint characteristic_size(const std::vector<double> &t_start, const std::vector<double> &sizes,
                              double threshold, double length, const Resampling &resampling = {});

/// Block length (in values) with the least mean-square error of the variance of the mean in a
/// circular block bootstrap: Politis & White 2004 (Econometric Reviews 23, 53) as corrected by
/// Patton, Politis & White 2009 (ibid. 28, 372). It grows as the cube root of the number of values:
/// blocks are long against the correlation, so that few sequences are cut, and short against the
/// series, so that there are many of them. Our choice: at least that cube root, so that
/// correlations too weak to be significant lag by lag are allowed for, and at most a tenth of the
/// series.
/// \param values consecutive values of a stationary series with mean 0
double block_length(const std::vector<double> &values);

/// How the characteristic size depends on the length of the fault.
enum class SizeDependence { power_law, none, undecided, saturates };
/// The same in words.
const char *to_string(SizeDependence dependence);

/// Factor for the standard errors of a law with too large a chi2: sqrt(chi2 / freedom) if a chi2 as
/// large has a probability below 1 %, otherwise 1. The points then scatter about the law by more
/// than their errors, so that errors from the curvature alone would be too small.
double error_scale(double chi2, int freedom);

/// Growth that saturates: s* = s_inf [1 + (L_c / L)^(D m)]^(-1/m), which is s_inf (L / L_c)^D for L
/// far below L_c and s_inf far above. Standard errors come from the curvature at the best fit,
/// times error_scale().
struct Saturation {
  /// Sharpness m of the bend. It is fixed because few lengths lie within the bend; L_c and D depend
  /// on it by more than their errors, see ScalingFit::bends.
  static constexpr double sharpness = 4.0;
  double m = sharpness;
  double s_inf = NAN, se_s_inf = s_inf;
  double L_c = s_inf, se_L_c = s_inf;
  double D = s_inf, se_D = s_inf;
  double chi2 = s_inf;  ///< in ln s*, points - 3 degrees of freedom
  double aicc = s_inf;
  /// All numbers are NaN if there are fewer than 5 usable points (AICc needs them) or fewer than 4
  /// lengths, if fewer than two lengths lie on either side of L_c, or if 0 is within the 95 %
  /// confidence interval of D.
  bool degenerate = true;
  std::string why;
};

/// Fits of s* = A L^D, of a constant, and of growth that saturates. The errors of A and D include
/// error_scale(); the choice between the laws uses chi2 and the errors without it.
struct ScalingFit {
  double A = NAN, se_A = A;
  double D = A, se_D = A;
  double chi2 = A;  ///< of the power law in ln s*, points - 2 degrees of freedom
  double constant = A, se_constant = A;
  double chi2_constant = A;            ///< of the constant, points - 1 degrees of freedom
  double aicc = A, aicc_constant = A;  ///< chi2 + 2 k + 2 k (k + 1) / (points - k - 1)
  int points = 0;
  Saturation saturation;
  /// Saturating fits with bends from round (m = 1) to sharp (m = 16), `saturation` among them: how
  /// much the choice of the form † adds to the uncertainty of L_c, s_inf and D.
  std::vector<Saturation> bends;
  /// Saturation is preferred if its AICc is lower than both others by more than 2. Otherwise the
  /// power law or the constant is preferred if its AICc is lower than the other's by more than 2;
  /// the constant only if D = 0 is also within the 95 % confidence interval of D, since with few
  /// points AICc alone accepts it up to 2.2 standard errors away.
  SizeDependence preferred = SizeDependence::undecided;
  bool degenerate = true;  ///< fewer than 4 usable points (AICc needs them), or one length
  std::string why;
};

/// Whether the preferred law fits poorly: a chi2 as large has a probability below 1 %.
bool fits_poorly(const ScalingFit &fit);

/// Ranges of m, L_c and D over the bends whose chi2 exceeds the smallest one by at most 4.
struct BendRange {
  Extent m, L_c, D;
};
/// Finds these ranges for the bends of a fit.
BendRange bends_as_good(const ScalingFit &fit);

/// Weighted least squares of ln s* on ln L.
/// \param points at least 4 usable ones for a result; degenerate points are left out
ScalingFit fit_scaling(const std::vector<SizePoint> &points);

}  // namespace LSM::postproc

#endif
