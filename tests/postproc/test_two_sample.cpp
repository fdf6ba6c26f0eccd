// SPDX-License-Identifier: GPL-2.0-or-later
// Two-sample tests: distances by hand, and the rate of false alarms, also for series with memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/random.h"
#include "two_sample.h"

using namespace LSM::postproc;

namespace {

double gaussian(LSM::Random &random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) *
         std::cos(6.283185307179586 * random.uniform());
}

/// Exponentials of an autoregressive series.
std::vector<double> series(LSM::Random &random, int n, double memory, double mean = 0.0) {
  std::vector<double> values;
  double x = gaussian(random);
  for (int i = 0; i < n; ++i) {
    x = memory * x + std::sqrt(1.0 - memory * memory) * gaussian(random);
    values.push_back(std::exp(mean + x));
  }
  return values;
}

/// Number of pairs of samples from the same law, out of `trials`, that have p < 0.05.
int alarms(int trials, double memory) {
  LSM::Random random(7);
  int count = 0;
  for (int i = 0; i < trials; ++i) {
    const auto a = series(random, 300, memory), b = series(random, 200, memory);
    if (two_sample_test(a, b, 199, 1).p.value < 0.05) ++count;
  }
  return count;
}

/// Of the shares of values up to any value.
double largest_difference(std::vector<double> a, std::vector<double> b) {
  double largest = 0.0;
  const auto share = [](const std::vector<double> &sorted, double x) {
    return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), x) - sorted.begin()) /
           static_cast<double>(sorted.size());
  };
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  for (const auto &values : {a, b})
    for (const double x : values) largest = std::max(largest, std::fabs(share(a, x) - share(b, x)));
  return largest;
}

}  // namespace

TEST(TwoSample, DistanceByHand) {
  const auto distance = [](const std::vector<double> &first, const std::vector<double> &second) {
    std::vector<double> a, b;
    for (int i = 0; i < 10; ++i) {
      a.insert(a.end(), first.begin(), first.end());
      b.insert(b.end(), second.begin(), second.end());
    }
    return two_sample_test(a, b, 1, 1).distance;
  };
  EXPECT_DOUBLE_EQ(distance({1, 2, 3}, {1, 2, 3}), 0.0);
  EXPECT_DOUBLE_EQ(distance({1, 2}, {3, 4, 5}), 1.0);
  EXPECT_DOUBLE_EQ(distance({1, 2, 3, 4}, {2.5, 5}), 0.5);
  EXPECT_DOUBLE_EQ(distance({1, 1, 2, 2}, {1, 2, 2, 2}), 0.25);  // ties
}

TEST(TwoSample, FalseAlarmsAsOftenAsStated) {
  // The rate must be within three standard deviations of the binomial distribution of 5 %.
  const int trials = 400;
  const double slack = 3.0 * std::sqrt(trials * 0.05 * 0.95);
  // For a memory of some events blocks are needed: in 2000 trials, 6 % differ with blocks and 28 %
  // without.
  for (const double memory : {0.0, 0.6})
    EXPECT_NEAR(alarms(trials, memory), 0.05 * trials, slack) << memory;
}

// So many values that samples are divided by classes of ranks.
TEST(TwoSample, ManyValues) {
  LSM::Random random(9);
  const int trials = 100;
  for (const double memory : {0.0, 0.8}) {
    int count = 0;
    for (int i = 0; i < trials; ++i) {
      const auto a = series(random, 9000, memory), b = series(random, 9000, memory);
      const TwoSampleTest test = two_sample_test(a, b, 99, 1);
      EXPECT_NEAR(test.distance, largest_difference(a, b), 1e-12);
      if (test.p.value < 0.055) ++count;
    }
    EXPECT_NEAR(count, 0.05 * trials, 3.0 * std::sqrt(trials * 0.05 * 0.95)) << memory;
  }
  EXPECT_LT(
      two_sample_test(series(random, 9000, 0.0), series(random, 9000, 0.0, 0.1), 99, 1).p.value,
      0.03);
  // Half of the sizes of one sample differ from the only size of the other.
  std::vector<double> same(20000, 1.0), half = same;
  for (std::size_t i = 0; i < half.size(); i += 2) half[i] = 2.0;
  EXPECT_EQ(two_sample_test(same, same, 49, 1).p.value, 1.0);
  EXPECT_EQ(two_sample_test(same, half, 49, 1).p.value, 0.02);
}

TEST(TwoSample, FindsDifferences) {
  LSM::Random random(3);
  const auto a = series(random, 500, 0.3), b = series(random, 500, 0.3, 0.5);
  const TwoSampleTest test = two_sample_test(a, b, 999, 1);
  EXPECT_EQ(test.p.error, std::sqrt(test.p.value * (1.0 - test.p.value) / 999));  // as of fits
  EXPECT_LE(test.p.value, 0.005);
  EXPECT_EQ(test.n[0], 500);
  EXPECT_NEAR(test.ratio.value, std::exp(0.5), 3.0 * test.ratio.error);
  EXPECT_DOUBLE_EQ(test.distance, largest_difference(a, b));
  // The same seed gives the same p.
  EXPECT_EQ(test.p.value, two_sample_test(a, b, 999, 1).p.value);
}

TEST(TwoSample, ErrorOfTheMeanAllowsForMemory) {
  // For few values the error of the mean of exp(x) has no closed form; it is compared with the
  // scatter of many series.
  LSM::Random random(11);
  double squares = 0.0, errors = 0.0, sum = 0.0;
  const int trials = 400;
  for (int i = 0; i < trials; ++i) {
    const auto a = series(random, 400, 0.6), b = series(random, 20, 0.0);
    const TwoSampleTest test = two_sample_test(a, b, 1, 1);
    squares += std::pow(test.means[0].value, 2);
    sum += test.means[0].value;
    errors += std::pow(test.means[0].error, 2);
  }
  const double scatter = std::sqrt(squares / trials - std::pow(sum / trials, 2));
  EXPECT_NEAR(std::sqrt(errors / trials) / scatter, 1.0, 0.2);
  EXPECT_NEAR(sum / trials, std::exp(0.5), 3.0 * scatter / std::sqrt(1.0 * trials));
}

TEST(TwoSample, RefusesWhatItCannotCompare) {
  const std::vector<double> few(9, 1.0), enough(10, 1.0);
  EXPECT_THROW(two_sample_test(few, enough, 10, 1), std::invalid_argument);
  EXPECT_THROW(two_sample_test(enough, few, 10, 1), std::invalid_argument);
  EXPECT_EQ(two_sample_test(enough, enough, 10, 1).p.value, 1.0);  // all equal
}
