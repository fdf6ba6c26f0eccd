// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "read_catalogue.h"
#include "read_series.h"
#include "slider_run.h"
#include "slider_ways.h"

namespace Slider {
namespace {

RunOptions options(int blocks, double dt, std::int64_t steps) {
  RunOptions o;
  o.parameters.blocks = blocks;
  o.parameters.dt = dt;
  o.mu = random_friction(blocks, 0.5, 1.0, 21);
  o.steps = steps;
  o.picker.lambda = 0.95;
  o.overwrite = true;
  return o;
}

TEST(SliderRun, PureLoadingOverAThousandMillionSteps) {
  for (LSM::PickerReading reading : {LSM::PickerReading::exponential, LSM::PickerReading::average,
                                     LSM::PickerReading::literal}) {
    RunOptions o = options(100, 0.05, 1000000000);
    o.parameters.velocity = 1e-7;  // the plate reaches 5, far from the onset at 50
    o.picker.reading = reading;
    o.filter.keep_nonpositive = true;
    const RunResult r = run(o);
    EXPECT_EQ(r.steps, 1000000000);
    EXPECT_EQ(r.events, 0);
    EXPECT_EQ(r.moved, 0);
    EXPECT_EQ(r.mean_slip, 0.0);
    EXPECT_NEAR(r.pe, 100 * 0.5 * 0.01 * 25.0, 1e-10);
    EXPECT_GT(r.jumped, 900000000);
  }
}

// A run, and what it must have at least.
struct Kind {
  RunOptions options;
  std::int64_t events, jumped, leaps;
};

std::vector<Kind> kinds() {
  std::vector<Kind> found;
  for (LSM::PickerReading reading : {LSM::PickerReading::exponential, LSM::PickerReading::average,
                                     LSM::PickerReading::literal}) {
    RunOptions o = options(24, 0.05, 2000000);
    o.parameters.kl = 0.2;
    o.picker.reading = reading;
    found.push_back({o, 20, 100000, 0});
  }
  for (const Events events : {Events::pe, Events::ruptures}) {
    RunOptions o = options(48, 0.05, 400000);
    o.parameters = coupled(Coupling::antiplane, 48, 0.05);
    o.parameters.radiation = 0.1;
    o.parameters.landscape.length = 3.0;
    o.events = events;
    if (events == Events::ruptures) o.header = {{"events", "ruptures"}};
    found.push_back({o, 20, 1000, 0});
  }
  RunOptions o = options(64, 0.05, 2800000);
  o.parameters.velocity = 1e-3;
  o.leap_speed = 1e-3;
  found.push_back({o, 5, 1000, 3});
  return found;
}

TEST(SliderRun, JumpsPartsAndSeriesChangeNoByte) {
  // The dense kernel takes every step, the active one jumps through quiet loading; a series has
  // samples within leaps; a run is continued from checkpoints, unless leaps depend on its end.
  for (Kind &kind : kinds()) {
    RunOptions &o = kind.options;
    const auto names = [&o](const char *which) {
      o.catalogue = testing::TempDir() + "slider_run_" + which + ".csv";
      o.checkpoint = o.catalogue + ".chk";
    };
    names("active");
    const RunResult active = run(o);
    EXPECT_GT(active.events, kind.events);
    EXPECT_GT(active.jumped, kind.jumped);
    EXPECT_GE(active.leaps, kind.leaps);
    EXPECT_NEAR(active.pe, active.pe_direct, 1e-9 * active.pe);
    // The whole state at the end: displacements, velocities, PE, picker.
    const std::string whole = text(o.catalogue), state = text(o.checkpoint);
    EXPECT_GT(state.size(), 500U);
    const std::int64_t end = o.steps;
    names("dense");
    o.dense = true;
    o.series = testing::TempDir() + "slider_run.pe";
    o.series_stride = 50;
    const RunResult dense = run(o);
    EXPECT_EQ(dense.jumped, 0);
    EXPECT_EQ(dense.leaps, active.leaps);
    EXPECT_EQ(dense.dropped_nonpositive, active.dropped_nonpositive);
    EXPECT_EQ(text(o.catalogue), whole);
    EXPECT_EQ(text(o.checkpoint), state);
    EXPECT_EQ(static_cast<std::int64_t>(unit::read_series(o.series).size()), end / 50 + 1);
    if (kind.leaps > 0) continue;
    o.series.clear();
    for (const std::int64_t steps : {end / 3, end}) {
      o.steps = steps;
      o.resume = steps == end;
      run(o);
    }
    EXPECT_EQ(text(o.catalogue), whole);
    EXPECT_EQ(text(o.checkpoint), state);
  }
}

TEST(SliderRun, DropsByThePlateAreCountedAndLeftOut) {
  RunOptions o = options(256, 0.05, 1200000);
  o.filter.warmup = 12000.0;
  o.picker.lambda = std::exp(-0.05);
  o.catalogue = testing::TempDir() + "slider_all_drops.csv";
  const RunResult all = run(o);
  o.catalogue = testing::TempDir() + "slider_slip_drops.csv";
  o.keep_by_plate = false;
  const RunResult slips = run(o);
  EXPECT_EQ(all.by_plate, slips.by_plate);
  ASSERT_GT(all.by_plate, 2);
  EXPECT_EQ(slips.events, all.events - all.by_plate);
  EXPECT_EQ(slips.steps, all.steps);
  EXPECT_EQ(slips.pe, all.pe);
  const double strongest = *std::max_element(o.mu.begin(), o.mu.end());
  auto both = unit::read_catalogue<LSM::Drop>(testing::TempDir() + "slider_all_drops.csv").events;
  both.erase(std::remove_if(both.begin(), both.end(),
                            [&](const LSM::Drop &e) { return e.size > strongest * e.slip_moment; }),
             both.end());
  const auto kept = unit::read_catalogue<LSM::Drop>(o.catalogue).events;
  ASSERT_EQ(kept.size(), both.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_EQ(kept[k].step_start, both[k].step_start);
    EXPECT_EQ(kept[k].size, both[k].size);
    EXPECT_EQ(kept[k].id, static_cast<std::int64_t>(k + 1));
  }
}

TEST(SliderRun, CentroidsAreOnTheRing) {
  // Ruptures that are symmetric about block 0 are at 0, and not at the end of the ring.
  for (const Events events : {Events::pe, Events::ruptures}) {
    RunOptions o = options(20, 0.05, 400000);
    o.parameters.velocity = 0.05;
    for (int i = 0; i < 20; ++i) {
      const int away = std::min(i, 20 - i);
      o.mu[static_cast<std::size_t>(i)] = 0.5 + 0.002 * away * away + 0.01 * (away * 7 % 5);
    }
    o.events = events;
    if (events == Events::ruptures) o.header = {{"events", "ruptures"}};
    o.x_centroid = true;
    o.catalogue = testing::TempDir() + "slider_mirrored.csv";
    run(o);
    const auto found = unit::read_catalogue<LSM::Drop>(o.catalogue).events;
    ASSERT_GT(found.size(), 30U);
    double least = 20.0;
    for (const LSM::Drop &e : found) {
      least = std::min(least, e.x_centroid);
      EXPECT_LT(e.x_centroid, 20.0);
    }
    EXPECT_LT(least, 0.01);
  }
}

}  // namespace
}  // namespace Slider
