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

enum class SizeDependence { power_law, none, undecided };
const char *to_string(SizeDependence dependence);

/// s* = A L^D against s* = constant.
struct ScalingFit {
  double A = std::numeric_limits<double>::quiet_NaN(), se_A = A;
  double D = A, se_D = A;
  double chi2 = A;  ///< of the power law in ln s*, points - 2 degrees of freedom
  double constant = A, se_constant = A;
  double chi2_constant = A;            ///< of the constant, points - 1 degrees of freedom
  double aicc = A, aicc_constant = A;  ///< chi2 + 2 k + 2 k (k + 1) / (points - k - 1)
  int points = 0;
  /// The model whose AICc is lower by more than 2; the constant only where D = 0 lies within the 95
  /// % interval of D, since with few points AICc alone takes it up to 2.2 standard errors off.
  SizeDependence preferred = SizeDependence::undecided;
  bool degenerate = true;  ///< fewer than 4 usable points (AICc needs them) or all of one length
  std::string why;
};

/// Weighted least squares of ln s* on ln L; degenerate points are left out.
ScalingFit fit_scaling(const std::vector<SizePoint> &points);

}  // namespace LSM::postproc

#endif
