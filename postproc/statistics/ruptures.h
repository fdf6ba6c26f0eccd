// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ruptures.h
/// Ruptures of a fault †: their numbers by length and moment, and relations of moment,
/// length and drop of PE.
#ifndef LSM_POSTPROC_RUPTURES_H
#define LSM_POSTPROC_RUPTURES_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"
#include "samples.h"

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

/// Moment of a rupture of one bin that slips at the threshold velocity for one interval: modulus,
/// slip velocity, time and width; 0 if the header lacks any of them.
double smallest_moment(const CatalogueInfo &info);

/// A rupture of positive moment.
struct RupturePoint {
  std::int64_t event_id;
  double length, moment, stress_drop;
  double pe_drop;           ///< of the total PE
  bool whole_fault, alone;  ///< alone: slips_by_itself()
};

/// Mean stress drop over two bins of the moment per decade, of three ruptures and more.
struct StressMean {
  double moment, mean, error;
};

/// One catalogue in scatters. Of very many ruptures these show the largest and one of some of the
/// others: pictures of a million points take minutes to draw and to look at.
struct RuptureScatter {
  static constexpr std::size_t most = 20000, largest = 1000;

  std::string label;
  std::size_t ruptures = 0, one_of = 1;  ///< one_of 1: all are shown
  std::vector<RupturePoint> shown;
  std::vector<StressMean> means;  ///< of all of them
};

/// How moment, length, drop of PE and stress drop of all ruptures depend on each other.
struct RuptureRelations {
  std::vector<RuptureScatter> catalogues;
  Extent lengths, moments, stress_drops;
  LogFit moment_of_length;      ///< without those of the whole fault
  Extent pe_drops, pe_moments;  ///< where PE fell
  std::int64_t pe_rose = 0;     ///< ruptures during which it did not
  LogFit pe_of_moment;
  LogFit pe_of_moment_alone;  ///< of those that slip by themselves; n < 3: too few
};

/// \throws std::runtime_error if there are too few ruptures for a fit
RuptureRelations rupture_relations(const std::vector<EventTable> &tables);

}  // namespace LSM::postproc

#endif
