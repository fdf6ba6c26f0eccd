// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/slip_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "events/drop_locator.h"

namespace {

using LSM::Drop;
using LSM::DropLocator;
using LSM::FaultGrid;
using LSM::FaultRow;
using LSM::SlipRecorder;
using Contacts = std::vector<LSM::FaultContact>;
using Faces = std::vector<LSM::FaceDisplacement>;

FaultGrid four_bins() {
  FaultGrid grid;
  grid.bins = 4;
  grid.x0 = 10.0;
  grid.width = 2.0;
  grid.step0 = 100;
  grid.interval = 5;
  return grid;
}

TEST(FaultGrid, IntervalsEndAfterTheFirst) {
  const FaultGrid grid = four_bins();
  EXPECT_FALSE(grid.ends_interval(95));
  EXPECT_FALSE(grid.ends_interval(100));  // the state before the first interval
  EXPECT_FALSE(grid.ends_interval(104));
  EXPECT_TRUE(grid.ends_interval(105));
  EXPECT_TRUE(grid.ends_interval(200));
}

// A run that blows up ends at the next check of PE, not at an index outside of an array.
TEST(FaultGrid, PlacesThatAreNotFiniteHaveABin) {
  FaultGrid grid = four_bins();
  for (const bool ring : {true, false}) {
    grid.ring = ring;
    for (const double place : std::vector<double>{NAN, INFINITY, -INFINITY, 1e200, -1e200}) {
      EXPECT_GE(grid.strike().bin(place), 0) << place;
      EXPECT_LT(grid.strike().bin(place), 4) << place;
    }
  }
}

TEST(SlipRecorder, SumsAlongTheDirectionOfDriving) {
  for (const double forward : {1.0, -1.0}) {
    SlipRecorder recorder;
    recorder.begin(four_bins(), forward);
    // x, work, force, share; the second one is across the seam
    recorder.add(Contacts{{13.0, 0.25, 2.0, 1.0}, {9.5, 4.0, 8.0, 0.5}});
    recorder.add(Contacts{{13.5, 0.5, 1.0, 1.0}});
    // x, displacement, steps, upper
    recorder.add(Faces{{12.5, 0.5, 5.0, true}, {13.5, 0.25, 5.0, true}, {8.5, -1.0, 5.0, false}});
    // displacements of the upper and the lower face with their steps, work, force
    // of the bins 1 and 3
    std::vector<double> expected(24, 0.0);
    const double one[] = {forward * 0.75, 10.0, 0, 0, 0.75, forward * 3.0};
    const double three[] = {0, 0, forward * -1.0, 5.0, 2.0, forward * 4.0};
    std::copy_n(one, 6, &expected[6]);
    std::copy_n(three, 6, &expected[18]);
    EXPECT_EQ(recorder.sums(), expected);
    recorder.clear();
    EXPECT_EQ(recorder.sums(), std::vector<double>(24, 0.0));
  }
}

TEST(SlipRecorder, BeforeTheFirstIntervalOnlyForcesCount) {
  SlipRecorder recorder;
  recorder.begin(four_bins(), -1.0);
  recorder.add_forces({{11.0, 0.25, 2.0, 0.5}});
  EXPECT_EQ(recorder.sums()[LSM::WORK], 0.0);
  EXPECT_EQ(recorder.sums()[LSM::FORCE], -1.0);
}

using Drops = std::vector<Drop>;

/// A drop between two steps of a fault whose first interval begins at step 100.
Drop drop(std::int64_t start, std::int64_t end) {
  Drop e;
  e.step_start = start;
  e.step_end = end;
  return e;
}

FaultRow slips(const std::vector<float> &of_bins) {
  FaultRow row(static_cast<int>(of_bins.size()));
  row.slip = of_bins;
  return row;
}

struct Located {
  DropLocator locator{four_bins(), 0.5, 0.1};
  Drops drops;
  DropLocator::Report report = [this](const Drop &e) { drops.push_back(e); };
};

TEST(DropLocator, MomentCentroidLengthAndPeak) {
  Located a;
  a.locator.add_interval(105, slips({1.0F, 0.0F, 0.0F, 0.0F}), {}, a.report);  // before the drop
  a.locator.add_interval(110, slips({0.0F, 2.0F, -1.0F, 0.25F}), 105, a.report);
  a.locator.add(drop(105, 110), a.report);
  ASSERT_EQ(a.drops.size(), 1u);
  const Drop &e = a.drops[0];
  EXPECT_EQ(e.slip_moment, 0.5 * (2.0 - 1.0 + 0.25) * 2.0);  // modulus, width 2
  EXPECT_EQ(e.peak_slip, 2.0);
  EXPECT_EQ(e.rupture_length, 6.0);
  // Weights 0, 2, 1 and 0.25 at 11, 13, 15, 17 of a ring of 8 from 10 on.
  const double c = 2.0 * std::cos(M_PI * 0.75) + std::cos(M_PI * 1.25) +
                   0.25 * std::cos(M_PI * 1.75),
               s = 2.0 * std::sin(M_PI * 0.75) + std::sin(M_PI * 1.25) +
                   0.25 * std::sin(M_PI * 1.75);
  EXPECT_NEAR(e.x_centroid, 10.0 + 8.0 * (std::atan2(s, c) / (2.0 * M_PI)), 1e-12);
}

TEST(DropLocator, BinsThatSlipLittleDidNotRupture) {
  Located a;
  a.locator.add_interval(105, slips({0.0F, 10.0F, 1.0F, 1.25F}), 100, a.report);
  a.locator.add(drop(100, 105), a.report);
  ASSERT_EQ(a.drops.size(), 1u);
  EXPECT_EQ(a.drops[0].rupture_length, 4.0) << "bin 2 has 0.1 of the largest, not more";
}

TEST(DropLocator, SlipIsInterpolatedInTheFirstAndTheLastInterval) {
  Located a;
  a.locator.add_interval(105, slips({5.0F, 0.0F, 0.0F, 0.0F}), 103, a.report);
  a.locator.add_interval(110, slips({1.0F, 0.0F, 0.0F, 0.0F}), 103, a.report);
  a.locator.add(drop(103, 111), a.report);
  a.locator.add(drop(112, 114), a.report);  // within an interval
  EXPECT_TRUE(a.drops.empty()) << "their interval is not complete";
  a.locator.add_interval(115, slips({0.5F, 0.0F, 0.0F, 0.0F}), {}, a.report);
  ASSERT_EQ(a.drops.size(), 2u);
  EXPECT_NEAR(a.drops[0].peak_slip, 2.0 + 1.0 + 0.1, 1e-15);
  EXPECT_NEAR(a.drops[1].peak_slip, 0.2, 1e-15);
}

TEST(DropLocator, ADropThatIsNotWrittenLeavesNoSlip) {
  Located a;
  a.locator.add_interval(105, slips({1.0F, 0.0F, 0.0F, 0.0F}), 100, a.report);
  a.locator.forget_open();
  a.locator.add_interval(110, slips({0.0F, 1.0F, 0.0F, 0.0F}), 105, a.report);
  a.locator.add(drop(105, 110), a.report);
  ASSERT_EQ(a.drops.size(), 1u);
  EXPECT_EQ(a.drops[0].rupture_length, 2.0);
  EXPECT_NEAR(a.drops[0].x_centroid, 13.0, 1e-12);
}

TEST(DropLocator, AtTheEndOfARunThePartOfTheIntervalCounts) {
  Located a;
  a.locator.add(drop(101, 103), a.report);
  a.locator.finish(104, slips({1.0F, 0.0F, 0.0F, 0.0F}), a.report);  // 4 of 5 steps
  ASSERT_EQ(a.drops.size(), 1u);
  EXPECT_EQ(a.drops[0].peak_slip, 0.5);
}

TEST(DropLocator, AFaultWithEnds) {
  FaultGrid open = four_bins();
  open.ring = false;
  DropLocator locator(open, 0.5, 0.1);
  Drops drops;
  const auto report = [&drops](const Drop &e) { drops.push_back(e); };
  locator.add_interval(105, slips({1.0F, 0.0F, 0.0F, 1.0F}), 100, report);
  locator.add(drop(100, 105), report);
  locator.add_interval(110, slips({0.0F, 0.0F, 0.0F, 0.0F}), 105, report);
  locator.add(drop(105, 110), report);
  ASSERT_EQ(drops.size(), 2u);
  EXPECT_EQ(drops[0].x_centroid, 14.0) << "the mean place, not that across the ends";
  EXPECT_EQ(drops[1].x_centroid, 10.0) << "nothing slid";
  EXPECT_EQ(drops[1].rupture_length, 0.0);
}

}  // namespace
