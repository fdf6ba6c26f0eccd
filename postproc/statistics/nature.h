// SPDX-License-Identifier: GPL-2.0-or-later
/// \file nature.h
/// Catalogues of models ranked by their distance to one of earthquakes †.
#ifndef LSM_POSTPROC_NATURE_H
#define LSM_POSTPROC_NATURE_H

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"
#include "samples.h"

namespace LSM::postproc {

struct NatureSettings {
  std::vector<double> thresholds;  ///< smallest sizes of the models; none: Threshold()
  std::vector<double> reference;   ///< smallest sizes of the earthquakes; none: all of them
  /// Times over their mean below this are left out of the fits of gamma; NaN: shortest_time().
  double shortest = NAN;
  double share = 0.02;       ///< of the events that count as large
  std::int64_t fewest = 50;  ///< events of a catalogue that is used
  int replicas = 200;        ///< of the errors of distances
  std::uint64_t seed = 1;
};

/// Catalogues of one label above one smallest size: means over them and their errors; of one
/// catalogue its own, or NaN.
struct NatureRow {
  std::string label, from;
  bool earthquakes = false;
  double threshold = 0.0;
  std::int64_t catalogues = 0, n = 0;  ///< n: events of all of them
  Measured b, variation, burstiness, memory, after_short, before, after;
  /// Of the generalised gamma density of the times over their mean, with delta = 1 and with a free
  /// one.
  Measured gamma, B, C, free_gamma, free_delta, free_B, free_C;
  std::int64_t without_delta = 0;  ///< catalogues that do not determine a free delta
  std::string why;                 ///< of one of them
  /// Of the times over their mean, and of the magnitudes above the smallest, to those of the first
  /// row of earthquakes: Kolmogorov-Smirnov.
  Measured distance, size_distance;
  std::vector<double> times;       ///< over their mean, of all catalogues
  std::vector<double> magnitudes;  ///< above the smallest, of all catalogues
};

/// One row for each label and smallest size, the earthquakes first, then by distance.
/// \param tables the first is the reference; those of the same label are samples of one model
/// \throws std::runtime_error if the reference has too few events
std::vector<NatureRow> nature_rows(const std::vector<EventTable> &tables,
                                   const NatureSettings &settings);

/// Densities of the times over their mean, five bins a decade, those of fewer than three left out.
std::vector<LogBin> time_densities(const NatureRow &row);

/// Share of the events with magnitudes of at least 0, 0.1, 0.2, ... above the smallest, to the
/// largest.
std::vector<double> shares_above(const NatureRow &row);

}  // namespace LSM::postproc

#endif
