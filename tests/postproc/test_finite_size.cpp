// SPDX-License-Identifier: GPL-2.0-or-later
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "coverage.h"
#include "finite_size.h"
#include "numerics/random.h"

namespace {

using namespace LSM::postproc;

std::vector<double> one_by_one(std::size_t n) {
  std::vector<double> times(n);
  std::iota(times.begin(), times.end(), 0.0);
  return times;
}

Resampling resampling(int replicas, std::uint64_t seed,
                      double block = std::numeric_limits<double>::quiet_NaN()) {
  Resampling result;
  result.replicas = replicas;
  result.seed = seed;
  result.block = block;
  return result;
}

TEST(CharacteristicSize, SmallExampleByHand) {
  std::vector<double> sizes = {1e-9, 0.5, -2.0};
  for (int i = 0; i < 10; ++i) sizes.push_back(1.0 + i);
  const SizePoint point = characteristic_size(one_by_one(13), sizes, 1.0, 120.0);
  ASSERT_FALSE(point.degenerate);
  // For independent events the error is sqrt(sum (s^2 - 7 s)^2) / 55.
  EXPECT_NEAR(point.error_independent, std::sqrt(1848.0) / 55.0, 1e-12);
  EXPECT_EQ(point.n, 10);
  EXPECT_EQ(point.length, 120.0);
  EXPECT_DOUBLE_EQ(point.s_star, 385.0 / 55.0);
}

TEST(CharacteristicSize, ErrorCoversTheTruth) {
  // Exponential sizes, <s^2> / <s> = 2, are resampled by events; uniform ones, 2 / 3, by blocks of
  // time.
  LSM::Random random(1);
  Coverage by_event(2.0), by_block(2.0 / 3.0);
  for (std::uint64_t i = 0; i < 300; ++i) {
    std::vector<double> sizes(2000);
    for (double &size : sizes) size = -std::log1p(-random.uniform());
    const auto times = one_by_one(sizes.size());
    const SizePoint single = characteristic_size(times, sizes, 0.0, 1.0, resampling(100, i, 0.0));
    by_event.add(single.s_star, single.error);
    EXPECT_EQ(single.blocks, 0);
    EXPECT_NEAR(single.error / single.error_independent, 1.0, 0.4);
    for (double &size : sizes) size = random.uniform();
    const SizePoint point = characteristic_size(times, sizes, 0.0, 1.0, resampling(200, i));
    by_block.add(point.s_star, point.error);
    EXPECT_GT(point.blocks, 100);
  }
  by_event.expect("s*, event by event");
  by_block.expect("s*, blocks of time");
}

// Sequences that begin at random times, with 10 events on average. Their sizes are uniform from a/2
// to 3a/2, where a is 1 or 3 for a whole sequence, so that <s> = 2, <s^2> = 5 * 13/12.
class Sequences {
 public:
  explicit Sequences(unsigned long seed) : rng_(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free) {
    gsl_rng_set(rng_.get(), seed);
  }
  static constexpr double truth = 2.5 * 13.0 / 12.0, pause = 100.0, delay = 30.0;
  // The error follows from the moments of a sequence: the number K of events is geometric, and with
  // z = s^2 - truth s, the deviation is the sum of z over the catalogue divided by that of s.
  static double error(double sequences) {
    const double mean_k = 10.0, mean_k2 = 190.0;
    double variance = 0.0;
    for (const double a : {1.0, 3.0}) {
      const double s2 = 13.0 / 12.0 * a * a, s3 = 1.25 * a * a * a, s4 = 1.5125 * a * a * a * a;
      const double mean = s2 - truth * a;
      const double square = s4 - 2.0 * truth * s3 + truth * truth * s2;
      variance += 0.5 * (mean_k * (square - mean * mean) + mean_k2 * mean * mean);
    }
    return std::sqrt(sequences * variance) / (sequences * mean_k * 2.0);
  }
  void catalogue(double duration, std::vector<double> &times, std::vector<double> &sizes) {
    std::vector<std::pair<double, double>> events;
    const double before = 20.0 * delay;  // sequences may begin before the catalogue
    for (double t = -before; (t += gsl_ran_exponential(rng_.get(), pause)) < duration;) {
      const double mean = gsl_rng_uniform_int(rng_.get(), 2) == 0 ? 1.0 : 3.0;
      for (unsigned int k = gsl_ran_geometric(rng_.get(), 0.1); k > 0; --k) {
        const double at = t + gsl_ran_exponential(rng_.get(), delay);
        if (at >= 0.0 && at < duration)
          events.emplace_back(at, mean * (0.5 + gsl_rng_uniform(rng_.get())));
      }
    }
    std::sort(events.begin(), events.end());
    times.clear();
    sizes.clear();
    for (const auto &[t, s] : events) {
      times.push_back(t);
      sizes.push_back(s);
    }
  }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
};

TEST(CharacteristicSize, ErrorCoversTheTruthThoughEventsComeInSequences) {
  Sequences source(2);
  Coverage blocks(Sequences::truth), by_event(Sequences::truth);
  const double sequences = 300.0;
  double error = 0.0, error_by_event = 0.0, length = 0.0;
  constexpr int trials = 300;
  std::vector<double> times, sizes;
  for (int i = 0; i < trials; ++i) {
    source.catalogue(sequences * Sequences::pause, times, sizes);
    const auto seed = static_cast<std::uint64_t>(i);
    const SizePoint point = characteristic_size(times, sizes, 0.0, 1.0, resampling(100, seed));
    const SizePoint single =
        characteristic_size(times, sizes, 0.0, 1.0, resampling(100, seed, 0.0));
    EXPECT_EQ(single.s_star, point.s_star);
    blocks.add(point.s_star, point.error);
    by_event.add(single.s_star, single.error);
    error += point.error / trials;
    error_by_event += single.error / trials;
    length += point.block / trials;
  }
  blocks.expect("s* of sequences");
  // The error is the known one; that for independent events is less than half of it.
  const double known = Sequences::error(sequences);
  EXPECT_NEAR(error / known, 1.0, 0.06);
  EXPECT_LT(error_by_event / known, 0.5);
  EXPECT_LT(by_event.within_two(), 0.7 * trials);
  EXPECT_GT(length, 2.0 * Sequences::delay);
  EXPECT_LT(length, 40.0 * Sequences::delay);
}

TEST(CharacteristicSize, BlocksOfTime) {
  Sequences source(3);
  std::vector<double> times, sizes;
  source.catalogue(2e4, times, sizes);
  const auto at = [&](double block) {
    return characteristic_size(times, sizes, 0.0, 1.0, resampling(400, 1, block));
  };
  const SizePoint given = at(1000.0);
  EXPECT_EQ(given.blocks, 20);
  EXPECT_NEAR(given.block, 1000.0, 30.0);
  // The shortest blocks contain at most one event, which is the same as resampling events.
  EXPECT_NEAR(at(0.5).error / at(0.0).error, 1.0, 0.15);
  EXPECT_GT(given.error / at(0.0).error, 1.3);
  EXPECT_THROW(at(1.1e4), std::invalid_argument);
  EXPECT_THROW(at(0.05), std::invalid_argument);
}

TEST(CharacteristicSize, BlocksGoRoundTheRing) {
  // The pattern is periodic: every half of the ring contains five periods, wherever it begins.
  std::vector<double> sizes;
  for (int i = 0; i < 40; ++i) sizes.push_back(1.0 + i % 4);
  const SizePoint point =
      characteristic_size(one_by_one(40), sizes, 0.0, 1.0, resampling(200, 1, 20.0));
  EXPECT_EQ(point.blocks, 2);
  EXPECT_NEAR(point.error, 0.0, 1e-9);
}

TEST(BlockLength, OfAnAutoregressiveSeries) {
  // x_i = rho x_(i-1) + noise has the covariances rho^|k|, from which the best length follows.
  const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng(gsl_rng_alloc(gsl_rng_mt19937),
                                                              gsl_rng_free);
  const std::size_t n = 8000;
  for (const double rho : {0.0, 0.6, 0.9}) {
    double mean = 0.0;
    for (int i = 0; i < 40; ++i) {
      std::vector<double> x(n);
      double last = gsl_ran_gaussian(rng.get(), 1.0 / std::sqrt(1.0 - rho * rho));
      for (double &x_i : x) x_i = last = rho * last + gsl_ran_gaussian(rng.get(), 1.0);
      mean += block_length(x) / 40.0;
    }
    const double best =
        std::cbrt(1.5 * std::pow(2.0 * rho / (1.0 - rho * rho), 2) * static_cast<double>(n));
    EXPECT_NEAR(mean / std::max(best, 20.0), 1.0, 0.1) << rho;  // 20 is the cube root of n
  }
  EXPECT_EQ(block_length(std::vector<double>(10, 0.0)), 1.0);
  EXPECT_EQ(block_length(std::vector<double>(1000, 0.0)), 10.0);
}

TEST(BlockLength, OfASeriesWhoseCorrelationEnds) {
  // Sums of five successive numbers are correlated up to lag 4. The same rule (Politis & White
  // 2004), written out for this case: lags up to 4 count in full, 5 to 7 less and less, 8 not at
  // all.
  LSM::Random random(7);
  const std::size_t n = 4000;
  std::vector<double> noise(n + 4), x(n, 0.0);
  for (double &e : noise) e = random.uniform() - 0.5;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 5; ++k) x[i] += noise[i + k];
  std::vector<double> r(10, 0.0);
  for (std::size_t lag = 0; lag < r.size(); ++lag)
    for (std::size_t i = 0; i + lag < n; ++i) r[lag] += x[i] * x[i + lag] / static_cast<double>(n);
  const double noticed = 2.0 * std::sqrt(std::log10(4000.0) / 4000.0) * r[0];
  EXPECT_GT(r[4], noticed);
  for (std::size_t lag = 5; lag < r.size(); ++lag) EXPECT_LT(std::fabs(r[lag]), noticed) << lag;
  const double full = r[1] + r[2] + r[3] + r[4] + 0.75 * r[5] + 0.5 * r[6] + 0.25 * r[7];
  const double moment =
      r[1] + 2.0 * r[2] + 3.0 * r[3] + 4.0 * r[4] + 3.75 * r[5] + 3.0 * r[6] + 1.75 * r[7];
  const double ratio = 2.0 * moment / (r[0] + 2.0 * full);
  EXPECT_NEAR(block_length(x), std::cbrt(1.5 * ratio * ratio * 4000.0), 1e-9);
}

TEST(CharacteristicSize, SameSeedSameError) {
  const std::vector<double> sizes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  for (const double block : {0.0, 2.0}) {
    const auto error = [&](std::uint64_t seed) {
      return characteristic_size(one_by_one(11), sizes, 0.0, 1.0, resampling(50, seed, block))
          .error;
    };
    EXPECT_GT(error(7), 0.0);
    EXPECT_EQ(error(7), error(7));
    EXPECT_NE(error(7), error(8));
  }
}

TEST(CharacteristicSize, Degenerate) {
  const SizePoint few = characteristic_size(one_by_one(9), std::vector<double>(9, 1.0), 0.0, 1.0);
  EXPECT_TRUE(few.degenerate);
  EXPECT_TRUE(std::isnan(few.s_star));
  EXPECT_NE(few.why.find("9 events"), std::string::npos);
  const SizePoint equal =
      characteristic_size(one_by_one(50), std::vector<double>(50, 1.0), 0.0, 1.0);
  EXPECT_TRUE(equal.degenerate);
  EXPECT_NE(equal.why.find("the same size"), std::string::npos);
  const SizePoint at_once =
      characteristic_size(std::vector<double>(50, 3.0), one_by_one(50), 0.0, 1.0);
  EXPECT_TRUE(at_once.degenerate);
  EXPECT_TRUE(std::isnan(at_once.s_star));
  EXPECT_NE(at_once.why.find("at the same time"), std::string::npos);
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
  // For equal relative errors, se = 0.01 / sqrt(sum (x - mean)^2).
  double mean = 0.0, spread = 0.0;
  for (double length : lengths) mean += std::log(length) / 6.0;
  for (double length : lengths) spread += std::pow(std::log(length) - mean, 2);
  EXPECT_NEAR(fit.se_D, 0.01 / std::sqrt(spread), 1e-12);
  EXPECT_NEAR(fit.aicc, 2.0 * 2.0 + 12.0 / 3.0, 1e-12);
  EXPECT_NEAR(fit.aicc_constant, fit.chi2_constant + 2.0 + 4.0 / 4.0, 1e-9);
}

TEST(Scaling, ErrorsOfAPoorLawGrowWithItsScatter) {
  // Points scatter by a tenth but have stated errors of a hundredth: the errors of D cover
  // nevertheless.
  EXPECT_EQ(error_scale(6.0, 4), 1.0);
  EXPECT_DOUBLE_EQ(error_scale(400.0, 4), 10.0);
  EXPECT_EQ(error_scale(5.0, 0), 1.0);
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(rng, 8);
  int covered = 0;
  constexpr int trials = 300;
  for (int i = 0; i < trials; ++i) {
    std::vector<SizePoint> points;
    for (double length : lengths) {
      const double s = std::sqrt(length) * std::exp(gsl_ran_gaussian(rng, 0.1));
      points.push_back(point(length, s, 0.01 * s));
    }
    const ScalingFit fit = fit_scaling(points);
    covered += std::fabs(fit.D - 0.5) < fit.se_D;
  }
  gsl_rng_free(rng);
  EXPECT_NEAR(static_cast<double>(covered) / trials, 0.63, 0.09);  // Student's t of 4 degrees
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
        // The stated error is relative to the measured value.
        points.back().error = points.back().s_star * relative;
      }
      const ScalingFit fit = fit_scaling(points);
      coverage.add(fit.D, fit.se_D);
      if (fit.preferred == SizeDependence::power_law) ++power_law;
      if (fit.preferred == SizeDependence::none) ++none;
    }
    coverage.expect("D = " + std::to_string(truth));
    if (truth == 0.0) {
      // AICc of 6 points: the power law has a penalty of 8 - 3 = 5. It is preferred if chi square
      // falls by more than 7, and rejected if by less than 3.
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

SizePoint noisy(double length, double s, double relative, gsl_rng *rng) {
  const double measured = s * std::exp(gsl_ran_gaussian(rng, relative));
  return point(length, measured, relative * measured);
}

double saturating(double length, double s_inf, double L_c, double D) {
  const double m = Saturation::sharpness;
  return s_inf * std::pow(1.0 + std::pow(L_c / length, D * m), -1.0 / m);
}

TEST(Saturation, ExactCurve) {
  std::vector<SizePoint> points;
  for (double length : {50, 100, 200, 400, 800, 1600, 3200, 6400}) {
    const double s = saturating(length, 8000.0, 700.0, 0.7);
    points.push_back(point(length, s, 0.01 * s));
  }
  const ScalingFit fit = fit_scaling(points);
  const Saturation &end = fit.saturation;
  ASSERT_FALSE(end.degenerate) << end.why;
  EXPECT_NEAR(end.s_inf, 8000.0, 1e-4);
  EXPECT_NEAR(end.L_c, 700.0, 1e-4);
  EXPECT_NEAR(end.D, 0.7, 1e-7);
  EXPECT_NEAR(end.chi2, 0.0, 1e-12);
  EXPECT_NEAR(end.aicc, 2.0 * 3.0 + 24.0 / 4.0, 1e-9);
  EXPECT_EQ(fit.preferred, SizeDependence::saturates);
}

// Points on a smooth bend: a sharper curve fits them worse and has another L_c and D.
TEST(Saturation, BendsTellTheForm) {
  std::vector<SizePoint> points;
  for (double length : {50, 100, 200, 400, 800, 1600, 3200, 6400}) {
    const double s = 8000.0 * std::pow(1.0 + std::pow(700.0 / length, 1.4), -0.5);
    points.push_back(point(length, s, 0.01 * s));
  }
  const ScalingFit fit = fit_scaling(points);
  ASSERT_EQ(fit.bends.size(), 5u);
  for (const Saturation &end : fit.bends) {
    ASSERT_FALSE(end.degenerate) << end.m << ": " << end.why;
    if (end.m == 2.0) {
      EXPECT_NEAR(end.L_c, 700.0, 1e-3);
      EXPECT_NEAR(end.D, 0.7, 1e-6);
      EXPECT_NEAR(end.chi2, 0.0, 1e-9);
    } else {
      EXPECT_GT(end.chi2, 1.0) << end.m;
      EXPECT_GT(std::fabs(end.L_c - 700.0), end.se_L_c) << end.m;
    }
    if (end.m == Saturation::sharpness) {
      EXPECT_EQ(end.L_c, fit.saturation.L_c);
    }
  }
  EXPECT_LT(fit.bends.back().D, fit.bends.front().D);
}

TEST(Saturation, IsRecognisedAndItsErrorsCover) {
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  const double s_inf = 8000.0, L_c = 2400.0, D = 0.7;
  Coverage covers_s(s_inf), covers_l(L_c), covers_d(D);
  const int trials = 400;
  int found = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<SizePoint> points;
    for (double length : {256, 614, 1928, 4000, 8000, 16000, 32000, 64000})
      for (int repeat = 0; repeat < 2; ++repeat)
        points.push_back(
            noisy(length, saturating(length, s_inf, L_c, D), length < 1000 ? 0.02 : 0.04, rng));
    const ScalingFit fit = fit_scaling(points);
    if (fit.preferred == SizeDependence::saturates) ++found;
    covers_s.add(fit.saturation.s_inf, fit.saturation.se_s_inf);
    covers_l.add(fit.saturation.L_c, fit.saturation.se_L_c);
    covers_d.add(fit.saturation.D, fit.saturation.se_D);
  }
  EXPECT_EQ(found, trials);
  covers_s.expect("s_inf");
  covers_l.expect("L_c");
  covers_d.expect("D");
  gsl_rng_free(rng);
}

/// Faults of each length: `repeats`; sizes that grow by a power of the length.
static void expect_no_saturation(int repeats) {
  gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
  for (double D : {0.0, 0.3, 1.0}) {
    for (int number : {6, 16}) {
      const int trials = 300;
      int found = 0;
      for (int i = 0; i < trials; ++i) {
        std::vector<SizePoint> points;
        for (int k = 0; k < number; ++k) {
          const double length = 100.0 * std::pow(2.0, k / repeats);
          points.push_back(noisy(length, 3.0 * std::pow(length, D), k % 2 == 0 ? 0.03 : 0.06, rng));
        }
        if (fit_scaling(points).preferred == SizeDependence::saturates) ++found;
      }
      EXPECT_LT(found, trials / 20)
          << "D = " << D << ", " << number << " points, " << repeats << " of each length";
    }
  }
  gsl_rng_free(rng);
}

TEST(Saturation, IsNotSeenWithoutIt) { expect_no_saturation(1); }
TEST(Saturation, IsNotSeenWithoutItInPairs) { expect_no_saturation(2); }

TEST(Saturation, DegenerateInput) {
  const auto curve = [](const std::vector<double> &at, double L_c, double D) {
    std::vector<SizePoint> points;
    for (double length : at) {
      const double s = saturating(length, 10.0, L_c, D);
      points.push_back(point(length, s, 0.001 * s));
    }
    return fit_scaling(points);
  };
  const auto reason = [](const ScalingFit &fit) {
    EXPECT_TRUE(fit.saturation.degenerate);
    EXPECT_TRUE(std::isnan(fit.saturation.L_c));
    EXPECT_TRUE(std::isnan(fit.saturation.chi2));
    EXPECT_TRUE(std::isnan(fit.saturation.aicc));
    EXPECT_NE(fit.preferred, SizeDependence::saturates);
    return fit.saturation.why;
  };
  EXPECT_EQ(reason(curve({1, 2, 4, 8}, 3, 1)), "4 usable points, at least 5 needed");
  EXPECT_EQ(reason(curve({1, 1, 2, 2, 4, 4}, 2, 1)), "3 different lengths, at least 4 needed");
  const std::string outside = "no end of growth with two lengths on either side of it";
  const std::vector<double> many = {1, 2, 4, 8, 16, 32, 64, 128};
  EXPECT_EQ(reason(curve(many, 1.5, 1.0)), outside);
  EXPECT_EQ(reason(curve(many, 90.0, 1.0)), outside);
  EXPECT_FALSE(curve(many, 3.0, 1.0).saturation.degenerate);
  EXPECT_FALSE(curve(many, 40.0, 1.0).saturation.degenerate);
  // The reverse is a decrease that ends, but no growth.
  EXPECT_FALSE(reason(curve(many, 12.0, -1.0)).empty());
}

TEST(Scaling, NamesOfTheOutcome) {
  EXPECT_STREQ(to_string(SizeDependence::none), "no dependence on the length");
  EXPECT_STREQ(to_string(SizeDependence::undecided), "undecided");
  EXPECT_STREQ(to_string(SizeDependence::power_law), "power law in the length");
  EXPECT_STREQ(to_string(SizeDependence::saturates), "growth that ends at a length");
}

}  // namespace
