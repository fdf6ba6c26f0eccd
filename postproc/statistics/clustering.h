// SPDX-License-Identifier: GPL-2.0-or-later
/// \file clustering.h
/// Whether events have a steady rate and whether they cluster: properties of a series of
/// inter-event times beyond its density, each compared with random series without memory.
///
/// Sources: Goh & Barabasi 2008, EPL 81, 48002 (burstiness, memory coefficient); Kim & Jo 2016,
/// Phys. Rev. E 94, 032311 (burstiness of a finite number of times). Test of the rate: †.
#ifndef LSM_POSTPROC_CLUSTERING_H
#define LSM_POSTPROC_CLUSTERING_H

#include <cmath>
#include <cstdint>
#include <vector>

namespace LSM::postproc {

/// Coefficient of variation: standard deviation over mean. The sum of squares is divided by n, as
/// the series is described rather than a population behind it.
/// \return NaN for fewer than two values
double variation_of(const std::vector<double> &times);

/// Burstiness (r - 1) / (r + 1) of a coefficient of variation r: -1 for a periodic series, 0 for
/// independent events, towards 1 for clustered ones.
double burstiness_of(double variation);

/// A statistic of a series compared with its distribution over random series.
struct AgainstChance {
  double value = NAN;
  double mean = NAN;       ///< over the random series
  double deviation = NAN;  ///< standard deviation over the random series
  /// Share of the random series, the observed one included, at least as far from the mean.
  double p = NAN;
};

/// Statistics of a series of inter-event times, each compared with random series.
struct Clustering {
  /// Coefficient of variation r. Random series: independent exponential times.
  AgainstChance variation;
  /// ((n + 1)^(1/2) r - (n - 1)^(1/2)) / (((n + 1)^(1/2) - 2) r + (n - 1)^(1/2)): 0 for independent
  /// times whatever n is, 1 if all events but one coincide. Random series: as for variation.
  AgainstChance finite_burstiness;
  /// Correlation of each time with the next one. Random series: permutations of the times.
  AgainstChance memory;
};

/// Compares the statistics of a series with those of random series.
/// \param times consecutive inter-event times, none negative
/// \param replicas number of random series, at least 1
/// \return NaN in all members for fewer than 12 times or if all are 0
Clustering clustering(const std::vector<double> &times, int replicas, std::uint64_t seed);

/// How steady the rate of events is.
struct Steadiness {
  /// Largest distance of the cumulative number of events from a straight line, over their number.
  double departure = NAN;
  /// Share of series with as large a departure if blocks of the times are permuted. Blocks keep
  /// short sequences intact, so a small p means that the rate varies over longer times than these.
  double p = NAN;
};

/// Tests whether the rate of events is constant †.
/// \param starts in ascending order; with fewer than 20 the result is empty
/// \param replicas number of permutations; 0: no p
Steadiness steadiness(const std::vector<double> &starts, int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
