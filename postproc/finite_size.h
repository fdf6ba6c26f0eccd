// SPDX-License-Identifier: GPL-2.0-or-later
/// \file finite_size.h
/// Does the roll-off of the event sizes move with the length of the fault? The paper (Sect. 4.2)
/// suspects a finite-size effect and leaves the question open; this test is ours.
#ifndef LSM_POSTPROC_FINITE_SIZE_H
#define LSM_POSTPROC_FINITE_SIZE_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace LSM::postproc {

/// Characteristic size of the events of one model.
struct SizePoint {
  double length = 0.0;  ///< fault length (model units) or number of blocks
  double s_star = std::numeric_limits<double>::quiet_NaN();  ///< <s^2> / <s>, energy units
  double error = std::numeric_limits<double>::quiet_NaN();   ///< bootstrap standard error
  std::int64_t n = 0;                                        ///< events at or above the threshold
  bool degenerate = true;  ///< fewer than 10 events, or all equal: s_star and error are NaN
  std::string why;
};

/// s* = <s^2> / <s> over the sizes at or above threshold; for a power law with exponent below 3 it
/// follows the roll-off. Error by resampling events (independent events assumed).
/// \throws std::invalid_argument for fewer than 2 replicas, or a length or threshold that is not
/// positive and finite (threshold may be 0)
SizePoint characteristic_size(const std::vector<double> &sizes, double threshold, double length,
                              int replicas = 200, std::uint64_t seed = 1);

enum class SizeDependence { power_law, none, undecided, saturates };
const char *to_string(SizeDependence dependence);

/// Growth that ends: s* = s_inf [1 + (L_c / L)^(D m)]^(-1/m), which is s_inf (L / L_c)^D far below
/// L_c and s_inf far above. Errors from the curvature at the best fit.
struct Saturation {
  /// m, how sharp the bend is. Fixed, as few lengths lie in it. D leans on it: ruptures of the
  /// block-slider, which 4 fits best, give D = 0.80, 0.68, 0.65 with m = 2, 4, 8.
  static constexpr double sharpness = 4.0;
  double s_inf = std::numeric_limits<double>::quiet_NaN(), se_s_inf = s_inf;
  double L_c = s_inf, se_L_c = s_inf;
  double D = s_inf, se_D = s_inf;
  double chi2 = s_inf;  ///< in ln s*, points - 3 degrees of freedom
  double aicc = s_inf;
  /// Fewer than 5 usable points (AICc needs them) or 4 lengths, not at least two lengths on either
  /// side of L_c, or 0 within the 95 % interval of D: all numbers are NaN.
  bool degenerate = true;
  std::string why;
};

/// s* = A L^D against s* = constant and growth that ends.
struct ScalingFit {
  double A = std::numeric_limits<double>::quiet_NaN(), se_A = A;
  double D = A, se_D = A;
  double chi2 = A;  ///< of the power law in ln s*, points - 2 degrees of freedom
  double constant = A, se_constant = A;
  double chi2_constant = A;            ///< of the constant, points - 1 degrees of freedom
  double aicc = A, aicc_constant = A;  ///< chi2 + 2 k + 2 k (k + 1) / (points - k - 1)
  int points = 0;
  Saturation saturation;
  /// Saturates where its AICc is lower than both others by more than 2. Else the one of power law
  /// and constant whose AICc is lower by more than 2; the constant only where D = 0 lies within the
  /// 95 % interval of D, since with few points AICc alone takes it up to 2.2 standard errors off.
  SizeDependence preferred = SizeDependence::undecided;
  bool degenerate = true;  ///< fewer than 4 usable points (AICc needs them) or all of one length
  std::string why;
};

/// Weighted least squares of ln s* on ln L; degenerate points are left out.
ScalingFit fit_scaling(const std::vector<SizePoint> &points);

}  // namespace LSM::postproc

#endif
