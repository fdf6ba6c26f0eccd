// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/block_sampler.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using LSM::BlockSampler;
using LSM::GatheredBlock;
using LSM::SampleBlock;

/// Combines the blocks of all ranks as rank 0 does; the sums of intervals are added up.
GatheredBlock gathered(const std::vector<SampleBlock> &blocks) {
  GatheredBlock all;
  all.first = blocks[0].first;
  all.count = blocks[0].count;
  all.ranks = static_cast<int>(blocks.size());
  all.intervals.assign(blocks[0].intervals.size(), 0.0);
  for (const SampleBlock &block : blocks) {
    all.pe.insert(all.pe.end(), block.pe.begin(), block.pe.end());
    for (std::size_t n = 0; n < block.intervals.size(); ++n) all.intervals[n] += block.intervals[n];
  }
  return all;
}

TEST(BlockSampler, FillsOneBlockWhileTheOtherIsOnItsWay) {
  BlockSampler sampler;
  sampler.resize(3);
  EXPECT_TRUE(sampler.empty());
  for (int step = 10; step < 13; ++step) {
    EXPECT_FALSE(sampler.full());
    sampler.add(step, 0.5 * step);
  }
  EXPECT_TRUE(sampler.full());
  const SampleBlock &sent = sampler.hand_over();
  EXPECT_TRUE(sampler.empty());
  const double *const at = sent.pe.data();
  sampler.add(13, 7.0);
  sampler.add(14, 8.0);
  EXPECT_EQ(sent.first, 10);
  EXPECT_EQ(sent.count, 3);
  EXPECT_EQ(sent.pe, (std::vector<double>{5.0, 5.5, 6.0}));
  EXPECT_EQ(sent.pe.data(), at);  // the buffer of a message in transit must not move

  const SampleBlock &next = sampler.hand_over();  // not full, as at the end of a run
  EXPECT_EQ(next.first, 13);
  EXPECT_EQ(next.count, 2);
  EXPECT_EQ(next.pe, (std::vector<double>{7.0, 8.0}));

  sampler.add(15, 9.0);
  const SampleBlock &last = sampler.hand_over();
  EXPECT_EQ(last.first, 15);
  EXPECT_EQ(last.pe, (std::vector<double>{9.0}));
}

TEST(BlockSampler, IntervalsGoWithTheirBlock) {
  BlockSampler sampler;
  sampler.resize(2);
  sampler.add(1, 0.0);
  sampler.add_interval({1.0, 2.0});
  sampler.add(2, 0.0);
  const SampleBlock first = sampler.hand_over();
  EXPECT_EQ(first.intervals, (std::vector<double>{1.0, 2.0}));
  sampler.add(3, 0.0);
  const SampleBlock second = sampler.hand_over();
  EXPECT_TRUE(second.intervals.empty());
}

TEST(GatheredBlock, TotalsOfAllRanksAreCompensated) {
  std::vector<SampleBlock> blocks(4);
  const double terms[4] = {1.0, 1e100, 1.0, -1e100};
  for (int rank = 0; rank < 4; ++rank) {
    blocks[static_cast<std::size_t>(rank)].count = 2;
    blocks[static_cast<std::size_t>(rank)].pe = {10.0 * rank, terms[rank]};
  }
  const GatheredBlock all = gathered(blocks);
  EXPECT_EQ(all.total(0), 60.0);
  EXPECT_EQ(all.total(1), 2.0);  // a plain sum gives 0
}

}  // namespace
