// SPDX-License-Identifier: GPL-2.0-or-later
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "coverage.h"
#include "finite_size.h"
#include "lsm_random.h"

namespace {

using namespace LSM::postproc;

TEST(CharacteristicSize, SmallExampleByHand) {
  std::vector<double> sizes = {1e-9, 0.5, -2.0};
  for (int i = 0; i < 10; ++i) sizes.push_back(1.0 + i);
  const SizePoint point = characteristic_size(sizes, 1.0, 120.0);
  ASSERT_FALSE(point.degenerate);
  EXPECT_EQ(point.n, 10);
  EXPECT_EQ(point.length, 120.0);
  EXPECT_DOUBLE_EQ(point.s_star, 385.0 / 55.0);
}

TEST(CharacteristicSize, ErrorCoversTheTruth) {
  // Exponential sizes: <s^2> / <s> = 2.
  LSM::Random random(1);
  Coverage coverage(2.0);
  for (std::uint64_t i = 0; i < 300; ++i) {
    std::vector<double> sizes(2000);
    for (double &size : sizes) size = -std::log1p(-random.uniform());
    const SizePoint point = characteristic_size(sizes, 0.0, 1.0, 100, i);
    coverage.add(point.s_star, point.error);
  }
  coverage.expect("s*");
}

TEST(CharacteristicSize, SameSeedSameError) {
  const std::vector<double> sizes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  const double error = characteristic_size(sizes, 0.0, 1.0, 50, 7).error;
  EXPECT_EQ(characteristic_size(sizes, 0.0, 1.0, 50, 7).error, error);
  EXPECT_NE(characteristic_size(sizes, 0.0, 1.0, 50, 8).error, error);
}

TEST(CharacteristicSize, DegenerateAndImpossible) {
  const SizePoint few = characteristic_size(std::vector<double>(9, 1.0), 0.0, 1.0);
  EXPECT_TRUE(few.degenerate);
  EXPECT_TRUE(std::isnan(few.s_star));
  EXPECT_NE(few.why.find("9 events"), std::string::npos);
  EXPECT_TRUE(characteristic_size(std::vector<double>(50, 1.0), 0.0, 1.0).degenerate);
  EXPECT_THROW(characteristic_size({}, 0.0, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(characteristic_size({}, 0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(characteristic_size({}, -1.0, 1.0), std::invalid_argument);
}

SizePoint point(double length, double s_star, double error) {
  SizePoint result;
  result.length = length;
  result.s_star = s_star;
  result.error = error;
  result.n = 1000;
  result.degenerate = false;
  return result;
}

const double lengths[] = {120, 240, 480, 945, 1440, 1890};

TEST(Scaling, ExactPowerLaw) {
  std::vector<SizePoint> points;
  for (double length : lengths) {
    const double s = 0.02 * std::pow(length, 1.5);
    points.push_back(point(length, s, 0.01 * s));
  }
  const ScalingFit fit = fit_scaling(points);
  ASSERT_FALSE(fit.degenerate);
  EXPECT_NEAR(fit.D, 1.5, 1e-12);
  EXPECT_NEAR(fit.A, 0.02, 1e-12);
  EXPECT_NEAR(fit.chi2, 0.0, 1e-15);
  EXPECT_EQ(fit.points, 6);
  EXPECT_EQ(fit.preferred, SizeDependence::power_law);
  // Equal relative errors: se = 0.01 / sqrt(sum (x - mean)^2).
  double mean = 0.0, spread = 0.0;
  for (double length : lengths) mean += std::log(length) / 6.0;
  for (double length : lengths) spread += std::pow(std::log(length) - mean, 2);
  EXPECT_NEAR(fit.se_D, 0.01 / std::sqrt(spread), 1e-12);
  EXPECT_NEAR(fit.aicc, 2.0 * 2.0 + 12.0 / 3.0, 1e-12);
  EXPECT_NEAR(fit.aicc_constant, fit.chi2_constant + 2.0 + 4.0 / 4.0, 1e-9);
}

TEST(Scaling, ErrorsCoverAndTheRightModelIsPreferred) {
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  for (double truth : {0.0, 0.5}) {
    Coverage coverage(truth);
    int power_law = 0, none = 0;
    for (int i = 0; i < 400; ++i) {
      std::vector<SizePoint> points;
      for (double length : lengths) {
        const double s = 3.0 * std::pow(length, truth);
        const double relative = length < 1000 ? 0.1 : 0.05;
        points.push_back(
            point(length, s * std::exp(gsl_ran_gaussian(rng, relative)), s * relative));
        // The error belongs to the measured value.
        points.back().error = points.back().s_star * relative;
      }
      const ScalingFit fit = fit_scaling(points);
      coverage.add(fit.D, fit.se_D);
      if (fit.preferred == SizeDependence::power_law) ++power_law;
      if (fit.preferred == SizeDependence::none) ++none;
    }
    coverage.expect("D = " + std::to_string(truth));
    if (truth == 0.0) {
      // AICc of 6 points: the power law pays 8 - 3 = 5 and needs a chi square gain above 7;
      // it loses clearly below 3.
      expect_binomial(power_law, 400, std::erfc(std::sqrt(7.0 / 2.0)), "wrongly a power law");
      expect_binomial(none, 400, std::erf(std::sqrt(3.0 / 2.0)), "no dependence");
    } else {
      EXPECT_EQ(power_law, 400);
    }
  }
  gsl_rng_free(rng);
}

TEST(Scaling, DegenerateInput) {
  std::vector<SizePoint> points = {point(1, 2, 0.1), point(2, 3, 0.1), point(3, 5, 0.1)};
  points.push_back(SizePoint{});  // degenerate points do not count
  const ScalingFit few = fit_scaling(points);
  EXPECT_TRUE(few.degenerate);
  EXPECT_TRUE(std::isnan(few.D));
  EXPECT_EQ(few.preferred, SizeDependence::undecided);
  EXPECT_NE(few.why.find("3 usable"), std::string::npos);
  const std::vector<SizePoint> same(5, point(120, 2, 0.1));
  EXPECT_TRUE(fit_scaling(same).degenerate);
}

TEST(Scaling, NamesOfTheOutcome) {
  EXPECT_STREQ(to_string(SizeDependence::none), "no dependence on the length");
  EXPECT_STREQ(to_string(SizeDependence::undecided), "undecided");
  EXPECT_STREQ(to_string(SizeDependence::power_law), "power law in the length");
}

}  // namespace
