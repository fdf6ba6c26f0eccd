// SPDX-License-Identifier: GPL-2.0-or-later
/// \file clustering.h
/// Whether events have a steady rate, and whether they cluster: what a series of
/// inter-event times says beyond its density, each beside series without memory.
///
/// Sources: Goh & Barabasi 2008, EPL 81, 48002 (burstiness, memory coefficient); Kim & Jo 2016,
/// Phys. Rev. E 94, 032311 (burstiness of a finite number of times); Livina et al. 2005, Phys. Rev.
/// Lett. 95, 208501 (times after short and long ones). Stretches and the test of the rate: †.
#ifndef LSM_POSTPROC_CLUSTERING_H
#define LSM_POSTPROC_CLUSTERING_H

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Groups of the times by length, equally many in each.
constexpr std::size_t thirds = 3, eighths = 8;

/// Numbers of events until `points` + 1 equally spaced times, the first and the last start among
/// them. \param starts in ascending order
std::vector<std::pair<double, std::int64_t>> cumulative_numbers(const std::vector<double> &starts,
                                                                int points);

/// Standard deviation of a series (its own, not that of a law behind it: the sum of squares is
/// divided by n) over its mean; NaN for fewer than two values.
double variation_of(const std::vector<double> &times);

/// (r - 1) / (r + 1) of a variation r: -1 periodic, 0 independent, to 1 clustered.
double burstiness_of(double variation);

/// A number of a series beside the same of random ones.
struct AgainstChance {
  double value = NAN;
  double mean = NAN;       ///< of the random series
  double deviation = NAN;  ///< their standard deviation
  /// Share of them, the series itself included, that are as far from their mean.
  double p = NAN;
};

struct Clustering {
  /// Standard deviation over mean, r. Random: independent exponential times.
  AgainstChance variation;
  double burstiness = NAN;
  /// ((n + 1)^(1/2) r - (n - 1)^(1/2)) / (((n + 1)^(1/2) - 2) r + (n - 1)^(1/2)), 0 for independent
  /// times whatever n is, 1 where all events but one come at once. Random: as above.
  AgainstChance finite_burstiness;
  /// Correlation of each time with the next one. Random: the times in random order.
  AgainstChance memory;
  /// Mean of the times that follow the shortest, the middle and the longest third, over the mean of
  /// all. Random: the times in random order.
  std::array<AgainstChance, thirds> after;
  /// The same of each eighth, from the shortest on (Livina et al. 2005 divide so).
  std::array<AgainstChance, eighths> after_eighth;
  /// Kolmogorov-Smirnov distance between the times after the shortest third and those after the
  /// longest, seen at the edges of 480 cells of equally many times. Random: in random order.
  AgainstChance after_distance;
};

/// \param times consecutive inter-event times, none negative
/// \param replicas random series, at least 1
/// Fewer than 12 times, or all of them 0: NaN.
Clustering clustering(const std::vector<double> &times, int replicas, std::uint64_t seed);

/// The times that follow the shortest, the middle and the longest third of the times.
std::array<std::vector<double>, thirds> times_after_thirds(const std::vector<double> &times);

/// A stretch of time and how steadily events came in it.
struct Stretch {
  double from = NAN, to = NAN;
  std::int64_t n = 0;
  /// Largest departure of the cumulative number from a straight line, over n.
  double departure = NAN;
};

struct Steadiness {
  Stretch whole;
  /// Share of series whose departure is as large with the times in random order, block by block,
  /// so that short sequences stay together: small where the rate changes for longer than those.
  double p = NAN;
  /// Stretches whose departure is at most the tolerance, those with the most events first, none of
  /// which overlap.
  std::vector<Stretch> steady;
};

/// \param starts ascending, at least 20
/// \param tolerance departure that a steady stretch may have
/// \param fewest events of a steady stretch
Steadiness steadiness(const std::vector<double> &starts, double tolerance, std::int64_t fewest,
                      int replicas, std::uint64_t seed);

/// Events around large ones, over the number that the mean rate has there.
struct AroundLarge {
  double before = NAN;  ///< within one mean time before them
  double after = NAN;   ///< within one mean time after them
};

/// \param starts, sizes of all events, in order of time
/// \param share of the events that count as large, those with the largest sizes
AroundLarge around_large(const std::vector<double> &starts, const std::vector<double> &sizes,
                         double share);

/// Kolmogorov-Smirnov distance of two series, each divided by its mean, and its standard deviation
/// when blocks of consecutive values are resampled (circular block bootstrap, block_length()).
/// \param first, second at least 12 values each, else NaN
Measured rescaled_distance(const std::vector<double> &first, const std::vector<double> &second,
                           int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
