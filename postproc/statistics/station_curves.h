// SPDX-License-Identifier: GPL-2.0-or-later
/// \file station_curves.h
/// Slip and slip rate at places of a fault, and the misfit between two records of one rupture †.
#ifndef LSM_STATISTICS_STATION_CURVES_H
#define LSM_STATISTICS_STATION_CURVES_H

#include <string>
#include <vector>

namespace LSM {

/// Slip and slip rate at a place; times ascend, and between them both are linear.
struct StationCurve {
  double x = 0.0;
  std::vector<double> t, slip, rate;
};

/// First time at which the slip rate exceeds a given rate; NaN if it never does.
double arrival(const StationCurve &curve, double rate);

/// One run, or one reference, at several places.
struct NamedCurves {
  std::string name;
  double spacing = 0.0;  ///< distance between the places of a run; 0 for a reference
  std::vector<StationCurve> stations;
};

/// Whether two places are equal up to rounding.
bool same_place(double a, double b);

/// Interpolates a run linearly between the two places nearest to x.
/// \throws std::invalid_argument if x is beyond the ends of the run
StationCurve at_place(const NamedCurves &run, double x);

/// Up to `most` places that all references have in common, evenly chosen if there are more.
std::vector<double> common_places(const std::vector<NamedCurves> &references, std::size_t most);

/// Misfit of a curve and a reference over the time that they have in common.
struct StationMisfit {
  double x = 0.0;
  double arrival = 0.0, reference_arrival = 0.0;  ///< NaN where there is none
  double end_slip = 0.0, reference_end_slip = 0.0;
  double peak = 0.0, reference_peak = 0.0;  ///< of the slip rate
  /// Relative L2 misfits: root of the sum of squared differences over that of the reference.
  double slip_l2 = 0.0, rate_l2 = 0.0;
};
/// Compares a curve with a reference.
/// \param rate slip rate above which the rupture has arrived
/// \param until end of the comparison
/// \throws std::invalid_argument if the curves have no time in common
StationMisfit misfit(const StationCurve &curve, const StationCurve &reference, double rate,
                     double until);

/// Misfit over several stations.
struct MisfitSummary {
  /// Root mean square difference over the stations where both curves have an arrival.
  double arrival = 0.0;
  double largest_arrival = 0.0;
  /// Root of the sum of squared differences, over that of the squared slips of the reference.
  double end_slip = 0.0;
  /// Largest of the relative differences.
  double largest_end_slip = 0.0;
  /// Root mean squares of the relative differences.
  double slip_l2 = 0.0, rate_l2 = 0.0, peak = 0.0;
};
/// Summarises the misfits of several stations.
MisfitSummary summary(const std::vector<StationMisfit> &stations);

/// Order of convergence: exponent of the error as a power of the spacing, from errors at two
/// spacings.
double order(double coarse_error, double fine_error, double coarse_spacing, double fine_spacing);

}  // namespace LSM

#endif
