// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ruptures.h
/// Ruptures of a fault †: their numbers by length and by moment, and relations between moment,
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

/// Least-squares line through logarithms, y = 10^intercept x^slope.
struct LogFit {
  std::int64_t n = 0;
  double slope = 0.0, slope_error = 0.0, intercept = 0.0;
  double scatter = 0.0;  ///< root mean square residual in decades
  /// y / x if y were proportional to x (10^mean of the logarithms), and its scatter in decades.
  double ratio = 0.0, ratio_scatter = 0.0;
};
/// Fits a line to the logarithms of pairs (x, y), both positive.
/// \throws DegenerateData for fewer than three pairs, or if all x are equal
LogFit fit_logarithms(const std::vector<std::pair<double, double>> &points);

/// For each rupture, whether all others that overlap with it in time have less than a tenth of its
/// moment together. (A drop of the total PE includes all of them.)
std::vector<bool> slips_by_itself(const std::vector<Event> &events);

enum class RuptureQuantity { length, moment };

/// Number of ruptures per unit of model time, of fault length and of the quantity, so that faults
/// of different lengths coincide if ruptures do not depend on the length of the fault. Moments are
/// counted in bins of equal logarithmic width. Lengths are whole numbers of bins of the fault, of
/// which a bin of the density covers as many as its width allows, one for the shortest lengths.
/// `density` and `error` are in these units and not normalised to one.
/// \return empty without ruptures, or if no time passes between the first start and the last end
/// \throws std::runtime_error if slip_bin in the header is not positive
std::vector<LogBin> rupture_densities(const EventTable &table, RuptureQuantity quantity);

/// Smallest moment that is resolved: one bin that slips at the threshold velocity for one interval
/// (modulus x slip velocity x time x width).
/// \return 0 if the header lacks any of these
double smallest_moment(const CatalogueInfo &info);

/// Rupture of positive moment, as a point in scatter plots.
struct RupturePoint {
  std::int64_t event_id;
  double length, moment, stress_drop;
  double pe_drop;           ///< drop of the total PE
  bool whole_fault, alone;  ///< alone: see slips_by_itself()
};

/// Mean stress drop of at least three ruptures, in bins of half a decade of the moment.
struct StressMean {
  double moment, mean, error;
};

/// Points of one catalogue for scatter plots. Of a very large number, only the largest ruptures and
/// every n-th of the others are shown: plots of a million points take minutes to draw and to
/// display.
struct RuptureScatter {
  static constexpr std::size_t most = 20000, largest = 1000;

  std::string label;
  std::size_t ruptures = 0, one_of = 1;  ///< every one_of-th is shown; 1: all
  std::vector<RupturePoint> shown;
  std::vector<StressMean> means;  ///< of all ruptures
};

/// Relations between moment, length, drop of PE and stress drop of all ruptures.
struct RuptureRelations {
  std::vector<RuptureScatter> catalogues;
  Extent lengths, moments, stress_drops;
  LogFit moment_of_length;      ///< without ruptures of the whole fault
  Extent pe_drops, pe_moments;  ///< of ruptures during which PE fell
  std::int64_t pe_rose = 0;     ///< number of ruptures during which it did not fall
  LogFit pe_of_moment;
  LogFit pe_of_moment_alone;  ///< of those that slip by themselves; n < 3: too few for a fit
};

/// Collects and fits the ruptures of all catalogues.
/// \throws DegenerateData if there are too few ruptures for a fit
RuptureRelations rupture_relations(const std::vector<EventTable> &tables);

}  // namespace LSM::postproc

#endif
