// SPDX-License-Identifier: GPL-2.0-or-later
/// \file finite_size.h
/// Does the roll-off of the event sizes move with the length of the fault? The paper (Sect. 4.2)
/// suspects a finite-size effect and leaves the question open; this test is †.
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
  /// What the error would be if the events were independent (from their moments).
  double error_independent = NAN;
  double block = 0.0;      ///< length of the blocks resampled (model time); 0: event by event
  int blocks = 0;          ///< as many make up the catalogue
  std::int64_t n = 0;      ///< events at or above the threshold
  bool degenerate = true;  ///< fewer than 10 events, or all equal: s_star and error are NaN
  std::string why;
};

/// How errors come from one catalogue.
struct Resampling {
  int replicas = 200;
  std::uint64_t seed = 1;
  /// Length of the blocks (model time); NaN: block_length(); 0: event by event, as if they were
  /// independent.
  double block = NAN;
};

/// s* = <s^2> / <s> over the sizes at or above threshold; for a power law with exponent below 3 it
/// follows the roll-off. Events cluster, so the error is that of a circular block
/// bootstrap in time (Politis & Romano 1992): stretches of the catalogue, joined to a ring, that
/// begin at random times, together as long as the catalogue. Event by event it would leave out the
/// correlation of events near to each other.
/// \param t_start of the events, in ascending order
/// \throws std::invalid_argument for a block longer than half the catalogue or shorter than a
/// hundredth of the mean interval
SizePoint characteristic_size(const std::vector<double> &t_start, const std::vector<double> &sizes,
                              double threshold, double length, const Resampling &resampling = {});

/// Number of values in a block with the least mean-square error of the variance of the mean, by
/// circular block bootstrap: Politis & White 2004 (Econometric Reviews 23, 53) as corrected by
/// Patton, Politis & White 2009 (ibid. 28, 372). It grows as the cube root of the number of values:
/// long against the correlation, so that few sequences are cut, and short against the series, so
/// that there are many blocks. Ours: not below the cube root itself, so that correlations too weak
/// to be significant lag by lag count all the same, and not above a tenth of the values.
/// \param values consecutive ones of a stationary series with mean 0
double block_length(const std::vector<double> &values);

enum class SizeDependence { power_law, none, undecided, saturates };
const char *to_string(SizeDependence dependence);

/// Factor of the errors of a law whose chi2 is too large: sqrt(chi2 / freedom) where a chi2 as
/// large has a probability below 1 %, else 1. The scatter about such a law is larger than the
/// errors of the points, and errors from their curvature alone would be too small.
double error_scale(double chi2, int freedom);

/// Growth that ends: s* = s_inf [1 + (L_c / L)^(D m)]^(-1/m), which is s_inf (L / L_c)^D far below
/// L_c and s_inf far above. Errors from the curvature at the best fit, times error_scale().
struct Saturation {
  /// m, how sharp the bend is. Fixed, as few lengths lie in it; L_c and D lean on it by more than
  /// their errors, see ScalingFit::bends.
  static constexpr double sharpness = 4.0;
  double m = sharpness;
  double s_inf = NAN, se_s_inf = s_inf;
  double L_c = s_inf, se_L_c = s_inf;
  double D = s_inf, se_D = s_inf;
  double chi2 = s_inf;  ///< in ln s*, points - 3 degrees of freedom
  double aicc = s_inf;
  /// Fewer than 5 usable points (AICc needs them) or 4 lengths, not at least two lengths on either
  /// side of L_c, or 0 within the 95 % interval of D: all numbers are NaN.
  bool degenerate = true;
  std::string why;
};

/// s* = A L^D against s* = constant and growth that ends. Errors of A and D times error_scale();
/// the choice between the laws is by chi2 and errors as they are.
struct ScalingFit {
  double A = NAN, se_A = A;
  double D = A, se_D = A;
  double chi2 = A;  ///< of the power law in ln s*, points - 2 degrees of freedom
  double constant = A, se_constant = A;
  double chi2_constant = A;            ///< of the constant, points - 1 degrees of freedom
  double aicc = A, aicc_constant = A;  ///< chi2 + 2 k + 2 k (k + 1) / (points - k - 1)
  int points = 0;
  Saturation saturation;
  /// The same with bends from round (m = 1) to sharp (m = 16), `saturation` among them: what the
  /// form † adds to the errors of L_c, s_inf and D.
  std::vector<Saturation> bends;
  /// Saturates where its AICc is lower than both others by more than 2. Else the one of power law
  /// and constant whose AICc is lower by more than 2; the constant only where D = 0 lies within the
  /// 95 % interval of D, since with few points AICc alone takes it up to 2.2 standard errors off.
  SizeDependence preferred = SizeDependence::undecided;
  bool degenerate = true;  ///< fewer than 4 usable points (AICc needs them) or all of one length
  std::string why;
};

/// Whether the law that is preferred fits poorly: chi2 as large in less than 1 % of all cases.
bool fits_poorly(const ScalingFit &fit);

/// The bends that are not worse than the best by more than 4 in chi2, and what they give.
struct BendRange {
  Extent m, L_c, D;
};
BendRange bends_as_good(const ScalingFit &fit);

/// Weighted least squares of ln s* on ln L; degenerate points are left out.
ScalingFit fit_scaling(const std::vector<SizePoint> &points);

}  // namespace LSM::postproc

#endif
