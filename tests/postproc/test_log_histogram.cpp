// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "coverage.h"
#include "log_histogram.h"
#include "numerics/random.h"

namespace {

using namespace LSM::postproc;

TEST(LogHistogram, SmallExampleByHand) {
  const auto bins = log_histogram({1.0, 1.5, 2.0, 9.0}, 2.0);
  ASSERT_EQ(bins.size(), 4u);  // [1,2) [2,4) [4,8) [8,16)
  const int counts[] = {2, 1, 0, 1};
  for (int i = 0; i < 4; ++i) {
    const LogBin &bin = bins[static_cast<std::size_t>(i)];
    const double lo = std::ldexp(1.0, i);
    EXPECT_DOUBLE_EQ(bin.lo, lo);
    EXPECT_DOUBLE_EQ(bin.hi, 2.0 * lo);
    EXPECT_DOUBLE_EQ(bin.centre, lo * std::sqrt(2.0));
    EXPECT_EQ(bin.count, counts[i]);
    EXPECT_DOUBLE_EQ(bin.density, counts[i] / (4.0 * lo));
    EXPECT_DOUBLE_EQ(bin.error, std::sqrt(counts[i]) / (4.0 * lo));
  }
}

TEST(LogHistogram, EveryValueLiesInItsBin) {
  // Values at the edges themselves and one rounding below, over the whole range of doubles.
  for (double factor : {1.1, usual_bin_factor, 2.0, 10.0}) {
    const double steps = 600.0 / std::log(factor);
    for (double n = -steps; n < steps; n += 7.0) {
      const double edge = std::pow(factor, std::floor(n));
      for (double value : {edge, std::nextafter(edge, 0.0)}) {
        const auto bins = log_histogram({value}, factor);
        ASSERT_EQ(bins.size(), 1u) << value;
        EXPECT_LE(bins[0].lo, value);
        EXPECT_GT(bins[0].hi, value);
      }
    }
  }
}

TEST(LogHistogram, ThresholdAndUpperLimitAreEdges) {
  const std::vector<double> values = {0.9e-4, 1.05e-4, 2e-4, 0.99e-3, 1.05e-3};
  const auto bins = log_histogram(values, usual_bin_factor, 1e-4, 1e-3);
  ASSERT_EQ(bins.size(), 10u);
  EXPECT_NEAR(bins.front().lo, 1e-4, 1e-13);
  EXPECT_NEAR(bins.back().hi, 1e-3, 1e-12);
  double integral = 0.0;
  for (const LogBin &bin : bins) integral += bin.density * (bin.hi - bin.lo);
  EXPECT_NEAR(integral, 1.0, 1e-12);
  // A threshold inside a bin leaves that bin out.
  EXPECT_GT(log_histogram(values, usual_bin_factor, 1.01e-4).front().lo, 1.1e-4);
  EXPECT_TRUE(log_histogram(values, usual_bin_factor, 1.0).empty());
}

TEST(LogHistogram, ValuesThatHaveNoBinDoNotCount) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto bins = log_histogram({0.0, -1.0, inf, std::nan(""), 3.0}, 2.0);
  ASSERT_EQ(bins.size(), 1u);
  EXPECT_EQ(bins[0].count, 1);
  EXPECT_EQ(bins[0].density, 0.5);
  EXPECT_TRUE(log_histogram({}).empty());
}

TEST(LogHistogram, RefusesFactors) {
  for (double factor : {1.0, 0.5, -2.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(log_histogram({}, factor), std::invalid_argument) << factor;
}

TEST(LogHistogram, PoissonErrorsCoverAKnownDensity) {
  // x = exp(10 t) with uniform t has the density 1 / (10 x): a share of 1/10 ln(factor) in each
  // bin.
  LSM::Random random(11);
  const double expected = std::log(2.0) / 10.0;
  int hits = 0, trials = 0;
  for (int sample = 0; sample < 40; ++sample) {
    std::vector<double> values;
    for (int i = 0; i < 20000; ++i) values.push_back(std::exp(10.0 * random.uniform()));
    for (const LogBin &bin : log_histogram(values, 2.0, 1.0, 8192.0)) {
      // The range shown has 13 bins of equal probability.
      const double truth = 1.0 / 13.0 / (bin.hi - bin.lo);
      if (std::fabs(bin.density - truth) <= bin.error) ++hits;
      ++trials;
    }
    const auto all = log_histogram(values, 2.0);
    EXPECT_NEAR(static_cast<double>(all[3].count), 20000 * expected,
                5.0 * std::sqrt(20000 * expected));
  }
  ASSERT_EQ(trials, 40 * 13);
  // Binomial counts scatter a little less than Poisson's: for p = 1/13 the interval is 4 % wider.
  expect_binomial(hits, trials, std::erf(std::sqrt(13.0 / 12.0 / 2.0)), "Poisson error");
}

}  // namespace
