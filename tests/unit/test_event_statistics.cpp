// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_statistics.h"

#include <gtest/gtest.h>

#include <random>

namespace {

TEST(EventStatistics, Polygamma) {  // Abramowitz & Stegun, table 6.1 and 6.4.10
  EXPECT_NEAR(Accuracy::polygamma(1.0).first, -0.57721566490153286, 1e-9);
  EXPECT_NEAR(Accuracy::polygamma(0.5).first, -1.9635100260214235, 1e-9);
  EXPECT_NEAR(Accuracy::polygamma(1.0).second, 1.6449340668482264, 1e-9);
  EXPECT_NEAR(Accuracy::polygamma(0.5).second, 4.9348022005446793, 1e-9);
}

TEST(EventStatistics, ChiSquareTail) {  // 5 % and 1 % points of printed tables
  EXPECT_NEAR(Accuracy::chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(Accuracy::chi_square_tail(5.991, 2), 0.05, 1e-4);
  EXPECT_NEAR(Accuracy::chi_square_tail(7.815, 3), 0.05, 1e-4);
  EXPECT_NEAR(Accuracy::chi_square_tail(13.277, 4), 0.01, 1e-4);
  EXPECT_NEAR(Accuracy::chi_square_tail(11.070, 5), 0.05, 1e-4);
  EXPECT_DOUBLE_EQ(Accuracy::chi_square_tail(0.0, 3), 1.0);
  EXPECT_THROW(Accuracy::chi_square_tail(1.0, 0), std::runtime_error);
  EXPECT_THROW(Accuracy::chi_square_tail(-1.0, 2), std::runtime_error);
}

TEST(EventStatistics, GammaDensityAndItsErrors) {
  // Fits to 400 samples: unbiased but for 3 / n, and their scatter is the stated standard error.
  std::mt19937_64 random(1);
  for (double gamma : {0.6, 1.0, 2.0}) {
    std::gamma_distribution<double> times(gamma, 150.0);
    double sum = 0.0, squares = 0.0, stated = 0.0, sum_b = 0.0, squares_b = 0.0, stated_b = 0.0;
    constexpr int fits = 400, n = 300;
    for (int k = 0; k < fits; ++k) {
      std::vector<double> t(n);
      for (double &v : t) v = times(random);
      const auto fit = Accuracy::gamma_density(t);
      sum += fit.gamma.value;
      squares += fit.gamma.value * fit.gamma.value;
      stated += fit.gamma.error;
      sum_b += fit.b.value;
      squares_b += fit.b.value * fit.b.value;
      stated_b += fit.b.error;
    }
    const double scatter = std::sqrt(squares / fits - std::pow(sum / fits, 2)),
                 scatter_b = std::sqrt(squares_b / fits - std::pow(sum_b / fits, 2));
    EXPECT_NEAR(sum / fits, gamma, gamma * 3.0 / n + 4.0 * scatter / std::sqrt(fits));
    EXPECT_NEAR(sum_b / fits, 150.0, 150.0 * 3.0 / n + 4.0 * scatter_b / std::sqrt(fits));
    EXPECT_NEAR(stated / fits / scatter, 1.0, 0.15);
    EXPECT_NEAR(stated_b / fits / scatter_b, 1.0, 0.15);
  }
  EXPECT_TRUE(std::isnan(Accuracy::gamma_density({1.0, 2.0}).gamma.value));
  EXPECT_THROW(Accuracy::gamma_density(std::vector<double>(20, 0.0)), std::runtime_error);
}

TEST(EventStatistics, AgreementFindsAScatterAndATrend) {
  const std::vector<double> dt = {0.015, 0.03, 0.06, 0.06};
  using E = Accuracy::Estimate;
  const auto same = Accuracy::agreement(dt, {E{1.0, 0.1}, E{1.05, 0.1}, E{0.95, 0.1}, E{1.0, 0.1}});
  EXPECT_GT(same.p_same, 0.5);
  EXPECT_GT(same.p_trend, 0.3);
  const auto off = Accuracy::agreement(dt, {E{1.0, 0.1}, E{1.5, 0.1}, E{1.0, 0.1}, E{1.0, 0.1}});
  EXPECT_LT(off.p_same, 1e-3);
  EXPECT_GT(off.p_trend, 0.05);
  // A slope that the test of the scatter alone does not detect.
  const auto slope = Accuracy::agreement(dt, {E{1.0, 0.1}, E{1.1, 0.1}, E{1.3, 0.1}, E{1.3, 0.1}});
  EXPECT_LT(slope.p_trend, 0.02);
  EXPECT_GT(slope.p_same, 0.05);
  // For two estimates with equal errors, scatter and trend are the same two-sided normal test.
  const auto two = Accuracy::agreement({0.03, 0.06}, {E{0.0, 1.0}, E{1.96 * std::sqrt(2.0), 1.0}});
  EXPECT_NEAR(two.p_same, 0.05, 1e-3);
  EXPECT_NEAR(two.p_trend, 0.05, 1e-3);
  // Values that could not be estimated are ignored.
  const auto one = Accuracy::agreement({0.03, 0.06}, {E{}, E{1.0, 0.1}});
  EXPECT_EQ(one.p_same, 1.0);
}

TEST(EventStatistics, PairsOneToOne) {
  const auto pairs = Accuracy::paired({1.0, 2.0, 2.1, 9.0}, {1.05, 2.05, 5.0}, 0.2);
  EXPECT_EQ(pairs.both, 2);  // the partner of 2.1 belongs to 2.0
  EXPECT_EQ(pairs.only_first, 2);
  EXPECT_EQ(pairs.only_second, 1);
  EXPECT_EQ(pairs.p(), 1.0);
  EXPECT_EQ(Accuracy::paired({}, {1.0}, 1.0).only_second, 1);
  // 1 against 16 events without a partner: (15 - 1)^2 / 17 = 11.53
  Accuracy::Pairs odd;
  odd.only_first = 1;
  odd.only_second = 16;
  EXPECT_NEAR(odd.p(), 6.85e-4, 1e-5);
  std::swap(odd.only_first, odd.only_second);
  EXPECT_NEAR(odd.p(), 6.85e-4, 1e-5);
}

}  // namespace
