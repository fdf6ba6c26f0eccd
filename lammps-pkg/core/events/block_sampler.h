// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/block_sampler.h
/// Records of every step, collected in blocks, so that ranks communicate once per block: one block
/// is filled while the previous one is on its way to rank 0.
#ifndef LSM_BLOCK_SAMPLER_H
#define LSM_BLOCK_SAMPLER_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "numerics/sum.h"

namespace LSM {

/// One rank's share of the samples of consecutive steps.
struct SampleBlock {
  std::int64_t first = 0;         ///< step of the first sample
  int count = 0;                  ///< number of samples
  std::vector<double> pe;         ///< of each step
  std::vector<double> friction;   ///< work that it took up in each step; empty if not recorded
  std::vector<double> intervals;  ///< SlipRecorder::sums() of the intervals that ended in the block

  void clear() {
    count = 0;
    pe.clear();
    friction.clear();
    intervals.clear();
  }
};

/// Fills blocks. A block handed over stays valid until the next one is.
class BlockSampler {
 public:
  /// Sets the length of a block. To be called while the block is empty.
  /// \param steps at least 1
  void resize(int steps) {
    steps_ = steps;
    for (SampleBlock *block : {&filling_, &handed_over_})
      block->pe.reserve(static_cast<std::size_t>(steps));
  }

  /// Adds an interval that ends with the step whose PE is added next.
  void add_interval(const std::vector<double> &sums) {
    filling_.intervals.insert(filling_.intervals.end(), sums.begin(), sums.end());
  }
  /// Adds the work of friction in the step whose PE is added next.
  void add_friction(double work) { filling_.friction.push_back(work); }
  void add(std::int64_t step, double pe) {
    if (filling_.count == 0) filling_.first = step;
    filling_.pe.push_back(pe);
    ++filling_.count;
  }

  bool empty() const { return filling_.count == 0; }
  bool full() const { return filling_.count >= steps_; }

  /// Returns the block and begins a new one.
  const SampleBlock &hand_over() {
    std::swap(filling_, handed_over_);
    filling_.clear();
    return handed_over_;
  }

 private:
  int steps_ = 1;
  SampleBlock filling_, handed_over_;
};

/// The blocks of all ranks, on rank 0.
struct GatheredBlock {
  std::int64_t first = 0;
  int count = 0, ranks = 1;
  std::vector<double> pe;         ///< count samples of each rank, one rank after the other
  std::vector<double> friction;   ///< sums over the ranks; empty if not recorded
  std::vector<double> intervals;  ///< sums over the ranks

  /// PE of all ranks.
  /// \param n index of the sample in the block
  double total(int n) const {
    NeumaierSum sum;
    for (int rank = 0; rank < ranks; ++rank)
      sum.add(pe[static_cast<std::size_t>(rank) * static_cast<std::size_t>(count) +
                 static_cast<std::size_t>(n)]);
    return sum.value();
  }
};

}  // namespace LSM

#endif
