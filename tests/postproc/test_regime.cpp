// SPDX-License-Identifier: GPL-2.0-or-later
#include "regime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "unit_files.h"

namespace {

using LSM::postproc::Regime;
using LSM::postproc::RegimeMeter;

// Adds a sawtooth that rises by `up` per sample for n samples and then falls back within m samples.
// \param times number of teeth
void saw_tooth(RegimeMeter &meter, double up, int n, int m, int times) {
  for (int k = 0; k < times; ++k) {
    for (int i = 0; i < n; ++i) meter.add(up * i);
    for (int i = 0; i < m; ++i) meter.add(up * n * (1.0 - static_cast<double>(i) / m));
  }
  meter.add(0.0);
}

TEST(Regime, OfASawToothIsTheRatioOfItsSlopes) {
  // With windows of 5 samples and flanks of 200 and 10, no window contains a turning point.
  RegimeMeter meter(0.5, 0.1, 120);
  saw_tooth(meter, 1e-3, 200, 10, 50);
  const Regime r = meter.result();
  EXPECT_DOUBLE_EQ(r.window, 0.5);
  EXPECT_EQ(r.windows, 50 * 210 / 5);
  EXPECT_NEAR(r.rise, 1e-2, 1e-14);
  EXPECT_NEAR(r.fall, 0.2, 1e-13);
  EXPECT_NEAR(r.saw_tooth, 20.0, 1e-10);
  EXPECT_NEAR(r.drop_over_load, 20.0, 1e-10);
  EXPECT_EQ(name_of(r), "stick-slip");
}

TEST(Regime, OfASymmetricSeriesIsOne) {
  RegimeMeter meter(0.3, 0.1, 120);
  for (int i = 0; i < 300000; ++i) meter.add(std::sin(0.002 * i) + std::sin(0.0071 * i));
  const Regime r = meter.result();
  EXPECT_NEAR(r.saw_tooth, 1.0, 0.01);
  EXPECT_EQ(name_of(r), "creep");
}

TEST(Regime, DoesNotGrowWithTheLengthOfTheSeries) {
  // With events of many sizes, the fastest fall grows with their number, but the mean does not.
  const auto of = [](int cycles) {
    RegimeMeter meter(1.0, 1.0, 120);
    double pe = 0.0, u = 0.5;
    for (int k = 0; k < cycles; ++k) {
      u = std::fmod(u * 997.0 + 0.123, 1.0);
      for (int i = 0; i < 20; ++i) meter.add(pe += 1.0);
      meter.add(pe -= 10.0 / std::pow(1.0 - 0.9999 * u, 0.45));
    }
    return meter.result();
  };
  const Regime brief = of(300), longer = of(30000);
  EXPECT_GT(longer.drop_over_load, 2.0 * brief.drop_over_load);
  EXPECT_NEAR(longer.saw_tooth / brief.saw_tooth, 1.0, 0.5);
}

// n faults of length 120 side by side, with different phases, each of which is a sawtooth that
// falls 12 times as fast as it rises.
TEST(Regime, OfALongFaultIsJudgedByItsLength) {
  for (const int n : {1, 4, 16}) {
    RegimeMeter meter(1.0, 1.0, 120.0 * n);
    for (int t = 0; t < 50000; ++t) {
      double pe = 0.0;
      for (int k = 0; k < n; ++k) {
        const double period = 130.0 * (1.0 + 0.37 * k / n),
                     phase = std::fmod(t + 71.0 * k * k, period) / period;
        pe += phase < 12.0 / 13 ? phase : 12.0 * (1.0 - phase);
      }
      meter.add(pe);
    }
    const Regime r = meter.result();
    std::printf("%d faults: saw-tooth %.2f, stick-slip above %.2f\n", n, r.saw_tooth, r.above);
    EXPECT_EQ(name_of(r), "stick-slip") << n;
    EXPECT_NEAR(r.above, 1 + 2 / std::sqrt(n), 1e-12);
  }
  EXPECT_EQ(LSM::postproc::stick_slip_above(40.0), 3.0);
  EXPECT_EQ(LSM::postproc::stick_slip_above(std::nan("")), 3.0);
}

TEST(Regime, FastestFallIsMeasuredByTheLargestRises) {
  // There are rises of 1 to 101 in any order, 99 % of them up to 100, and one fall of 200.
  RegimeMeter meter(1.0, 1.0, 120);
  double pe = 0.0;
  meter.add(pe);
  for (int k = 0; k < 101; ++k) meter.add(pe += 1 + 37 * k % 101);
  meter.add(pe - 200.0);
  EXPECT_DOUBLE_EQ(meter.result().drop_over_load, 2.0);
}

TEST(Regime, TimeInEventsAndMeanDuration) {
  RegimeMeter meter(1.0, 1.0, 120);
  saw_tooth(meter, 1.0, 90, 10, 1);  // 101 samples: 100 time units
  meter.event(10.0, 25.0);
  meter.event(90.0, 95.0);
  EXPECT_DOUBLE_EQ(meter.result().time_in_events, 0.2);
  EXPECT_DOUBLE_EQ(meter.result().mean_duration, 10.0);
}

TEST(Regime, SeriesWithoutAFallOrARiseHasNone) {
  RegimeMeter rising(1.0, 1.0, 120), falling(1.0, 1.0, 120), empty(1.0, 1.0, 120);
  for (int i = 0; i < 100; ++i) {
    rising.add(i);
    falling.add(-i);
  }
  const auto why = [](const RegimeMeter &meter) {
    return unit::message_of<std::runtime_error>([&meter] { meter.result(); });
  };
  EXPECT_TRUE(unit::contains(why(rising), "PE only rises"));
  EXPECT_TRUE(unit::contains(why(falling), "PE only falls"));
  EXPECT_TRUE(unit::contains(why(empty), "shorter than two windows of 1 time units"));
}

}  // namespace
