// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/slip_recorder.h"

#include <gtest/gtest.h>

#include <vector>

#include "events/pe_drops.h"

namespace {

using LSM::Event;
using LSM::EventLocator;
using LSM::FaultGrid;
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
    const std::vector<double> expected = {0,
                                          0,
                                          0,
                                          0,
                                          0,
                                          0,  // bin 0
                                          forward * 0.75,
                                          10.0,
                                          0,
                                          0,
                                          0.75,
                                          forward * 3.0,  // bin 1
                                          0,
                                          0,
                                          0,
                                          0,
                                          0,
                                          0,  // bin 2
                                          0,
                                          0,
                                          forward * -1.0,
                                          5.0,
                                          2.0,
                                          forward * 4.0};  // bin 3
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

TEST(EventLocator, MomentCentroidAndLength) {
  EventLocator locator(0.5, 0.1);
  locator.add({{4, 1.0}, {6, 1.0}});
  locator.add({{5, 2.0}, {9, 0.2}});
  locator.add({{5, 1.0}});
  Event event;
  // Bins 4 to 6 ruptured; bin 9 has less than a tenth of the 3 of bin 5.
  locator.locate(100.0, 40.0, event);
  EXPECT_EQ(event.slip_moment, 5.2);
  EXPECT_EQ(event.rupture_length, 1.5);
  EXPECT_NEAR(event.x_centroid, 100.0 + (5.0 * 2.75 + 0.2 * 4.75) / 5.2, 2e-3);
}

TEST(EventLocator, TheSeamIsNoPlaceOfItsOwn) {
  EventLocator locator(1.0, 0.0);
  locator.add({{0, 1.0}, {9, 1.0}});  // around 0 of a period of 10
  Event event;
  locator.locate(0.0, 10.0, event);
  EXPECT_NEAR(std::min(event.x_centroid, 10.0 - event.x_centroid), 0.0, 1e-12);
  EXPECT_EQ(event.rupture_length, 2.0);
  locator.clear();
  locator.add({{8, 1.0}, {1, 1.0}, {9, 2.0}});
  locator.locate(0.0, 10.0, event);
  EXPECT_GT(event.x_centroid, 9.0);
  EXPECT_LT(event.x_centroid, 10.0);
}

TEST(EventLocator, NoLongerThanTheFault) {
  EventLocator locator(3.0, 0.0);  // the fourth bin is cut by the seam
  locator.add({{0, 1.0}, {1, 1.0}, {2, 1.0}, {3, 1.0}});
  Event event;
  locator.locate(0.0, 10.0, event);
  EXPECT_EQ(event.rupture_length, 10.0);
}

TEST(EventLocator, GoesOnFromItsState) {
  EventLocator first(1.0, 0.05), second(1.0, 0.05);
  first.add({{3, 0.1}, {-1, 0.7}, {12, 1.0 / 3.0}});
  std::vector<double> saved = {42.0};
  const std::vector<double> state = first.state();
  saved.insert(saved.end(), state.begin(), state.end());
  second.add({{5, 1.0}});
  second.set_state(saved, 1);
  for (EventLocator *locator : {&first, &second}) locator->add({{3, 0.2}});
  Event a, b;
  first.locate(0.0, 20.0, a);
  second.locate(0.0, 20.0, b);
  EXPECT_EQ(a.slip_moment, b.slip_moment);
  EXPECT_EQ(a.x_centroid, b.x_centroid);
  EXPECT_EQ(a.rupture_length, b.rupture_length);
}

}  // namespace
