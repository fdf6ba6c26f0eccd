// SPDX-License-Identifier: GPL-2.0-or-later
/// \file station_curves.h
/// Slip and slip rate at places of a fault, and how far two records of one rupture are apart
/// †.
#ifndef LSM_STATISTICS_STATION_CURVES_H
#define LSM_STATISTICS_STATION_CURVES_H

#include <string>
#include <vector>

namespace LSM {

/// Times rise; between them slip and rate are linear.
struct StationCurve {
  double x = 0.0;
  std::vector<double> t, slip, rate;
};

/// First time at which the slip rate exceeds that, or NaN.
double arrival(const StationCurve &curve, double rate);

/// One run, or one reference, at several places.
struct NamedCurves {
  std::string name;
  double spacing = 0.0;  ///< of the places of a run, 0 of a reference
  std::vector<StationCurve> stations;
};

/// Whether two places are the same but for rounding.
bool same_place(double a, double b);

/// The run at x, linear between its two nearest places. \throws std::invalid_argument beyond its
/// ends
StationCurve at_place(const NamedCurves &run, double x);

/// Up to `most` places that all references have, evenly chosen if there are more.
std::vector<double> common_places(const std::vector<NamedCurves> &references, std::size_t most);

/// How far a curve is from a reference, over the times that both have.
struct StationMisfit {
  double x = 0.0;
  double arrival = 0.0, reference_arrival = 0.0;  ///< NaN where there is none
  double end_slip = 0.0, reference_end_slip = 0.0;
  double peak = 0.0, reference_peak = 0.0;  ///< of the slip rate
  double slip_l2 = 0.0,
         rate_l2 =
             0.0;  ///< root of the sum of squares of the difference, over that of the reference
};
/// rate: above which slip has arrived. until: end of the comparison.
/// \throws std::invalid_argument if they have no time in common
StationMisfit misfit(const StationCurve &curve, const StationCurve &reference, double rate,
                     double until);

/// The same over several stations.
struct MisfitSummary {
  double arrival = 0.0;  ///< root mean square, over the stations where both have one
  double largest_arrival = 0.0;
  double end_slip = 0.0;          ///< root of the sum of squares, over that of the reference
  double largest_end_slip = 0.0;  ///< of the relative differences
  double slip_l2 = 0.0, rate_l2 = 0.0,
         peak = 0.0;  ///< root mean squares of the relative differences
};
MisfitSummary summary(const std::vector<StationMisfit> &stations);

/// Exponent of an error in the spacing, from two of each.
double order(double coarse_error, double fine_error, double coarse_spacing, double fine_spacing);

}  // namespace LSM

#endif
