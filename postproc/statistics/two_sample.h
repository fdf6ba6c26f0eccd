// SPDX-License-Identifier: GPL-2.0-or-later
/// \file two_sample.h
/// Whether two series come from the same distribution, for catalogues that are expected to agree:
/// other time steps, seeds, numbers of ranks, leaps.
#ifndef LSM_POSTPROC_TWO_SAMPLE_H
#define LSM_POSTPROC_TWO_SAMPLE_H

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Result of two_sample_test().
struct TwoSampleTest {
  std::array<std::int64_t, 2> n = {0, 0};
  double distance = NAN;  ///< Kolmogorov-Smirnov distance
  /// Share of random divisions, the true one included, with as large a distance.
  Measured p;
  int block = 1;  ///< values in a block
  /// The errors allow for autocorrelation; NaN for fewer than two blocks.
  std::array<Measured, 2> means;
  Measured ratio;  ///< mean of the second series over that of the first
};

/// Permutation test of the Kolmogorov-Smirnov distance. As events cluster, blocks of consecutive
/// values are permuted between the series; permuting single values would reject too often for
/// autocorrelated series.
///
/// A block has the longer of the two block_length() of the ranks. For more than 16384 values in
/// both series together, at most 2048 blocks are used, and p is computed from distances evaluated
/// at 511 ranks only, both for the series and for their divisions; test.distance is exact.
///
/// \param first, second positive values in order of time
/// \param replicas number of random divisions, at least 1
/// \throws std::invalid_argument for fewer than 10 values in a series
TwoSampleTest two_sample_test(const std::vector<double> &first, const std::vector<double> &second,
                              int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
