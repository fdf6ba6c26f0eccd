// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ruptures.h
/// Ruptures of a fault (all ours): their numbers by length and moment, and relations of moment,
/// length and drop of PE.
#ifndef LSM_POSTPROC_RUPTURES_H
#define LSM_POSTPROC_RUPTURES_H

#include <cstdint>
#include <utility>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"

namespace LSM::postproc {

/// Line through logarithms, y = 10^intercept x^slope, by least squares.
struct LogFit {
  std::int64_t n = 0;
  double slope = 0.0, slope_error = 0.0, intercept = 0.0;
  double scatter = 0.0;  ///< root mean square distance in decades
  /// Of y / x, if y were proportional to x: 10^mean of the logarithms, and its scatter in decades.
  double ratio = 0.0, ratio_scatter = 0.0;
};
/// Both of each pair have to be positive. \throws std::runtime_error for fewer than three pairs, or
/// of one x only
LogFit fit_logarithms(const std::vector<std::pair<double, double>> &points);

/// Whether the ruptures at the same time as each one (which a drop of the total PE includes as
/// well) have less than a tenth of its moment together.
std::vector<bool> slips_by_itself(const std::vector<Event> &events);

enum class RuptureQuantity { length, moment };

/// Ruptures per unit of model time, of length of the fault, and of the quantity, so that faults of
/// other lengths coincide if ruptures do not depend on the length. Moments in bins of equal
/// width in the logarithm. Lengths are whole numbers of bins of the fault: a bin of the density
/// holds as many of these numbers as its width says, one each for the shortest.
/// `density` and `error` are in these units, not normalised to one.
/// Empty if there is no time between the first start and the last end, or no rupture.
std::vector<LogBin> rupture_densities(const EventTable &table, RuptureQuantity quantity);

}  // namespace LSM::postproc

#endif
