// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "numerics/random.h"

using namespace LSM;
using namespace LSM::postproc;

namespace {

std::vector<double> exponential(std::size_t n, Random &random) {
  std::vector<double> times(n);
  for (double &time : times) time = -std::log1p(-random.uniform());
  return times;
}

std::vector<double> starts_of(const std::vector<double> &times) {
  std::vector<double> starts{0.0};
  for (const double time : times) starts.push_back(starts.back() + time);
  return starts;
}

// Times of known mean and standard deviation.
TEST(Clustering, ClosedForms) {
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(i % 2 ? 3.0 : 1.0);
  const Clustering c = clustering(times, 50, 1);
  EXPECT_NEAR(c.variation.value, 0.5, 1e-14);
  const double up = std::sqrt(21.0), down = std::sqrt(19.0);
  EXPECT_NEAR(c.finite_burstiness.value, (0.5 * up - down) / (0.5 * (up - 2.0) + down), 1e-14);
  EXPECT_NEAR(c.memory.value, -1.0, 1e-14);
  EXPECT_LT(c.memory.p, 0.05);
}

// What does not exist cannot be compared with chance.
TEST(Clustering, WithoutAStatisticThereIsNoP) {
  const Clustering c = clustering(std::vector<double>(20, 2.0), 50, 1);
  EXPECT_TRUE(std::isnan(c.memory.value));
  EXPECT_TRUE(std::isnan(c.memory.p));
}

// The form for finite n is 1 if all times but one are 0, and -1 for periodic times, whatever n.
TEST(Clustering, FiniteBurstinessReachesItsEnds) {
  for (const std::size_t n : {12u, 100u}) {
    std::vector<double> times(n, 0.0);
    times[5] = 1.0;
    EXPECT_NEAR(clustering(times, 2, 1).finite_burstiness.value, 1.0, 1e-12);
    EXPECT_EQ(clustering(std::vector<double>(n, 2.0), 2, 1).finite_burstiness.value, -1.0);
  }
}

// For independent times no statistic deviates from chance more often than stated.
TEST(Clustering, IndependentTimesAreSeenAsSuch) {
  Random random(5);
  int off = 0, trials = 0;
  for (int k = 0; k < 100; ++k) {
    const Clustering c = clustering(exponential(100, random), 99, 7);
    for (const AgainstChance &one : {c.variation, c.finite_burstiness, c.memory}) {
      ++trials;
      if (one.p <= 0.05) ++off;
    }
  }
  EXPECT_GT(off, 0.01 * trials);
  EXPECT_LT(off, 0.10 * trials);
}

// Runs of short and of long times have memory: short times follow short ones, long follow long
// ones.
TEST(Clustering, RunsHaveMemory) {
  Random random(3);
  std::vector<double> times = exponential(2000, random);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] *= (i / 20) % 2 ? 5.0 : 0.2;
  const Clustering c = clustering(times, 99, 1);
  EXPECT_GT(c.memory.value, 0.2);
  EXPECT_LE(c.memory.p, 0.01);
  EXPECT_GT(c.finite_burstiness.value, 0.2);
}

TEST(Steadiness, TellsASteadyRateFromOneThatChanges) {
  Random random(2);
  std::vector<double> times = exponential(3000, random);
  EXPECT_GT(steadiness(starts_of(times), 99, 1).p, 0.05);
  for (std::size_t i = 2000; i < times.size(); ++i) times[i] *= 0.1;
  const auto starts = starts_of(times);
  const Steadiness s = steadiness(starts, 99, 1);
  EXPECT_LE(s.p, 0.01);
  EXPECT_GT(s.departure, 0.2);
}

TEST(Steadiness, DepartureOfAKnownSeries) {
  // Ten events are in the first tenth of the time, ten in the rest.
  std::vector<double> starts;
  for (int i = 0; i < 10; ++i) starts.push_back(i);
  for (int i = 1; i <= 10; ++i) starts.push_back(9.0 + 8.1 * i);
  EXPECT_NEAR(steadiness(starts, 9, 1).departure, 0.5 - 0.1, 0.011);
}

}  // namespace
