// SPDX-License-Identifier: GPL-2.0-or-later
/// \file nature.h
/// Catalogues of models ranked by their distance to a catalogue of earthquakes †.
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

/// What nature_rows() compares.
struct NatureSettings {
  std::vector<double> thresholds;  ///< smallest sizes for the models; empty: Threshold()
  std::vector<double> reference;   ///< smallest sizes for the earthquakes; empty: all events
  /// Times (divided by their mean) below this are not used to fit gamma; NaN: shortest_time().
  double shortest = NAN;
  double share = 0.02;       ///< share of the events that count as large, see around_large()
  std::int64_t fewest = 50;  ///< smallest number of events of a catalogue that is used
  int replicas = 200;        ///< bootstrap samples for the errors of the distances
  std::uint64_t seed = 1;
};

/// Catalogues of one label above one smallest size. The numbers are means over the catalogues with
/// their standard errors; for a single catalogue they are its own, with an error of NaN if it has
/// none.
struct NatureRow {
  std::string label, from;
  bool earthquakes = false;
  double threshold = 0.0;
  std::int64_t catalogues = 0, n = 0;  ///< n: number of events in all catalogues
  Measured b, variation, burstiness, memory, after_short, before, after;
  /// Generalised gamma density of the times divided by their mean, with delta = 1 and with a free
  /// delta.
  Measured gamma, B, C, free_gamma, free_delta, free_B, free_C;
  std::int64_t without_delta = 0;  ///< number of catalogues that do not determine a free delta
  std::string why;                 ///< the reason for one of them
  /// Kolmogorov-Smirnov distances from the first row of earthquakes: of the times divided by their
  /// mean, and of the magnitudes above the smallest one.
  Measured distance, size_distance;
  std::vector<double> times;       ///< divided by their mean, of all catalogues
  std::vector<double> magnitudes;  ///< above the smallest one, of all catalogues
};

/// Computes one row for each label and smallest size: the earthquakes first, then by distance.
/// \param tables the first is the reference; tables with equal labels are samples of one model
/// \throws std::invalid_argument for a smallest size of 0, which has no magnitude
/// \throws std::runtime_error if the reference has too few events, or if all events of a catalogue
/// start at the same time
std::vector<NatureRow> nature_rows(const std::vector<EventTable> &tables,
                                   const NatureSettings &settings);

/// Densities of the times divided by their mean, with five bins per decade; bins with fewer than
/// three times are left out.
std::vector<LogBin> time_densities(const NatureRow &row);

/// Share of the events whose magnitudes are at least 0, 0.1, 0.2, ... above the smallest one, up to
/// the largest.
std::vector<double> shares_above(const NatureRow &row);

}  // namespace LSM::postproc

#endif
