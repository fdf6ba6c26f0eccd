// SPDX-License-Identifier: GPL-2.0-or-later
// Periods in the times of events are found where there is one, and only there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "event_table.h"
#include "numerics/random.h"
#include "periods.h"

namespace {

using namespace LSM;
using namespace LSM::postproc;

struct Series {
  std::vector<double> times, weights;
};

/// Independent events over 70 periods, with weights of which a few dominate.
/// \param tied share of the events that lie in the third tenth of the period
Series events_of(int n, double tied, Random &random) {
  Series out;
  for (int i = 0; i < n; ++i) {
    const double at = 70.0 * random.uniform();
    out.times.push_back(random.uniform() < tied ? std::floor(at) + 0.2 + 0.1 * random.uniform()
                                                : at);
    out.weights.push_back(std::pow(1.0 - random.uniform(), -0.6));
  }
  std::sort(out.times.begin(), out.times.end());
  return out;
}

TEST(Periods, ByHand) {
  // The phases differ by a quarter of a period: the resultant is the diagonal of the weights.
  const std::vector<double> times = {0.0, 0.25}, weights = {3.0, 4.0};
  EXPECT_NEAR(rayleigh_z(times, weights, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(rayleigh_z(times, weights, 0.25), 49.0 / 25.0, 1e-12);
  EXPECT_NEAR(rayleigh_z(times, weights, 0.5), 1.0 / 25.0, 1e-12);
  EXPECT_DOUBLE_EQ(effective_number({2.0, 2.0, 2.0}), 3.0);
  EXPECT_DOUBLE_EQ(effective_number({1.0, 0.0}), 1.0);
}

TEST(Periods, ChanceIsOneAndAlarmsAreAsRareAsStated) {
  Random random(5);
  double sum = 0.0;
  int alarms = 0, of_scans = 0;
  constexpr int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    const Series events = events_of(200, 0.0, random);
    const PeriodTest test = test_period(events.times, events.weights, 1.0, 199, 1);
    sum += test.z;
    alarms += test.p.value <= 0.05;
    const PeriodScan scan = scan_periods(events.times, std::vector<double>(200, 1.0), 0.5, 5.0);
    of_scans += *std::max_element(scan.z.begin(), scan.z.end()) > scan.by_chance;
  }
  EXPECT_NEAR(sum / trials, 1.0, 0.2);
  EXPECT_NEAR(alarms / static_cast<double>(trials), 0.05, 0.04);
  EXPECT_NEAR(of_scans / static_cast<double>(trials), 0.05, 0.04);
}

TEST(Periods, FoundWhereThereIsOne) {
  Random random(6);
  const Series events = events_of(400, 0.3, random);
  const PeriodTest test = test_period(events.times, events.weights, 1.0, 999, 1);
  EXPECT_GT(test.z, 4.0);
  EXPECT_LT(test.p.value, 0.01);
  EXPECT_EQ(test.p.error, std::sqrt(test.p.value * (1.0 - test.p.value) / 999));  // as of fits
  EXPECT_NEAR(test.phase, 0.25, 0.08);
  EXPECT_EQ(std::max_element(test.tenths.begin(), test.tenths.end()) - test.tenths.begin(), 2);
  double sum = 0.0;
  for (const double tenth : test.tenths) sum += tenth;
  EXPECT_NEAR(sum, 10.0, 1e-9);
  const PeriodScan scan = scan_periods(events.times, events.weights, 0.55, 5.0);
  const auto top = std::max_element(scan.z.begin(), scan.z.end());
  EXPECT_GT(*top, scan.by_chance);
  EXPECT_NEAR(scan.periods[static_cast<std::size_t>(top - scan.z.begin())], 1.0, 0.02);
  EXPECT_THROW(test_period(events.times, events.weights, 0.0, 9, 1), std::invalid_argument);
  EXPECT_THROW(test_period({1, 2}, {1, 1}, 1.0, 9, 1), std::invalid_argument);
}

TEST(Periods, EnergyAtEqualTimes) {
  Random random(7);
  const Series a = events_of(600, 0.5, random), b = events_of(600, 0.5, random),
               c = events_of(600, 0.0, random), d = events_of(600, 0.0, random);
  const Coincidence tied = coincidence(a.times, std::vector<double>(600, 1.0), b.times,
                                       std::vector<double>(600, 1.0), 0.1, 499, 1);
  EXPECT_GT(tied.correlation, 0.3);
  // One in ten shifts is by whole periods and gives the same correlation.
  EXPECT_LT(tied.p.value, 0.15);
  const Coincidence free = coincidence(c.times, c.weights, d.times, d.weights, 0.1, 499, 1);
  EXPECT_LT(std::fabs(free.correlation), 0.2);
  EXPECT_GT(free.p.value, 0.01);
  EXPECT_EQ(free.p.error, std::sqrt(free.p.value * (1.0 - free.p.value) / 499));
  EXPECT_NEAR(static_cast<double>(free.bins), 697.0, 5.0);
  EXPECT_THROW(coincidence(a.times, a.weights, b.times, b.weights, 10.0, 9, 1),
               std::invalid_argument);
}

TEST(Periods, VelocityOfThePlates) {
  EventTable table;
  table.info.model = "lsm";
  EXPECT_TRUE(std::isnan(table.plate_velocity()));
  table.info.parameters = {{"velocity", "-0.00025"}};
  EXPECT_DOUBLE_EQ(table.plate_velocity(), 0.0005);
  table.info.model = "block-slider";
  EXPECT_DOUBLE_EQ(table.plate_velocity(), 0.00025);
  table.info.parameters.push_back({"driving", "0.01"});
  EXPECT_DOUBLE_EQ(table.plate_velocity(), 0.01);
}

}  // namespace
