// SPDX-License-Identifier: GPL-2.0-or-later
/// \file two_sample.h
/// Do two series come from the same law? For catalogues that ought to agree: other time steps,
/// seeds, ranks, leaps.
#ifndef LSM_POSTPROC_TWO_SAMPLE_H
#define LSM_POSTPROC_TWO_SAMPLE_H

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

struct TwoSampleTest {
  std::array<std::int64_t, 2> n = {0, 0};
  double distance = NAN;  ///< Kolmogorov-Smirnov
  /// Share of random divisions, the true one included, whose distance is as large.
  Measured p;
  int block = 1;  ///< values that are kept together
  /// The errors allow for values that depend on those before them; NaN: fewer than two blocks.
  std::array<Measured, 2> means;
  Measured ratio;  ///< second mean over the first
};

/// Largest distance between the empirical distributions of two samples, neither of them empty.
double two_sample_distance(std::vector<double> first, std::vector<double> second);

/// Permutation test of the Kolmogorov-Smirnov distance. Events cluster, so that blocks of
/// consecutive values change sides, not single ones: with single ones, series that depend on their
/// past differ too often.
/// More than 16384 values of both series together: at most 2048 blocks, and the distance that p is
/// reckoned from, of the series as of their divisions, is that at 511 ranks; test.distance is
/// exact. \param first, second positive values in the order of time \param replicas random
/// divisions, at least 1 \param block values in a block, at least 1; 0: the longer of the two
/// block_length() of the ranks; with a length given, the cost of a division grows with the number
/// of values \throws std::invalid_argument for fewer than 10 values in a series
TwoSampleTest two_sample_test(const std::vector<double> &first, const std::vector<double> &second,
                              int replicas, std::uint64_t seed, int block = 0);

}  // namespace LSM::postproc

#endif
