// SPDX-License-Identifier: GPL-2.0-or-later
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "coverage.h"
#include "numerics/random.h"
#include "monte_carlo.h"
#include "power_law.h"
#include "sample.h"
#include "truncated_family.h"

namespace {

using namespace LSM::postproc;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> sample_of(std::size_t n, LSM::Random &random,
                              const std::function<double(double)> &quantile) {
  std::vector<double> sample(n);
  for (double &x : sample) x = quantile(random.uniform());
  std::sort(sample.begin(), sample.end());
  return sample;
}

// Inverse of the distribution by the textbook formula, independent of the code under test.
std::vector<double> power_law_sample(std::size_t n, double alpha, double lo, double hi,
                                     LSM::Random &random) {
  return sample_of(n, random, [=](double p) {
    if (alpha == 1.0) return lo * std::pow(hi / lo, p);
    const double e = 1.0 - alpha, a = std::pow(lo, e), b = hi == infinity ? 0.0 : std::pow(hi, e);
    return std::clamp(std::pow(a + p * (b - a), 1.0 / e), lo, hi);
  });
}

// Integral over [lo, hi] by GSL with u = ln x, panel by panel.
double integrate(const std::function<double(double)> &density, double lo, double hi) {
  gsl_integration_workspace *work = gsl_integration_workspace_alloc(1000);
  struct Context {
    const std::function<double(double)> *f;
  } context{&density};
  gsl_function function;
  function.params = &context;
  function.function = [](double u, void *p) {
    return (*static_cast<Context *>(p)->f)(std::exp(u)) * std::exp(u);
  };
  const double first = std::log(lo), last = std::log(hi);
  double total = 0.0;
  for (int i = 0; i < 20; ++i) {
    double value = 0.0, error = 0.0;
    gsl_integration_qag(&function, first + (last - first) * i / 20,
                        first + (last - first) * (i + 1) / 20, 0.0, 1e-12, 1000, GSL_INTEG_GAUSS61,
                        work, &value, &error);
    total += value;
  }
  gsl_integration_workspace_free(work);
  return total;
}

// Series replace the closed forms where those suffer from cancellation: tested are values on both
// sides of the border, and 0.
TEST(PowerLaw, MeanAndVarianceAgreeWithQuadratureForAnyTilt) {
  for (double z : {0.0, 1e-9, 1e-4, 0.03, 0.07, 0.0999, 0.1001, 0.5, 3.0, 30.0}) {
    const auto moment = [&](double shift, int power) {
      return integrate([&](double t) { return std::pow(t - shift, power) * std::exp(-z * t); },
                       1e-14, 1.0);
    };
    const double total = moment(0.0, 0), mean = moment(0.0, 1) / total;
    const double variance = moment(mean, 2) / total;
    EXPECT_NEAR(tilted_mean(-z), mean, 1e-11) << z;
    EXPECT_NEAR(tilted_mean(z), 1.0 - mean, 1e-11) << z;
    EXPECT_NEAR(tilted_variance(z), variance, 2e-11) << z;
    EXPECT_NEAR(tilted_variance(-z), variance, 2e-11) << z;
    EXPECT_NEAR(log_normalisation(-z), std::log(total), 1e-11) << z;
  }
}

TEST(PowerLaw, LikelihoodAgreesWithQuadrature) {
  LSM::Random random(1);
  for (double alpha : {-0.5, 0.5, 0.999999, 1.0, 1.000001, 1.5, 2.5}) {
    for (double hi : {30.0, 1e4}) {
      const auto sample = power_law_sample(300, alpha, 0.01, hi, random);
      const PowerLawFit fit = fit_power_law(sample, 0.01, hi);
      ASSERT_FALSE(fit.degenerate) << fit.why;
      const auto log_likelihood = [&](double exponent) {
        const double z = integrate([&](double x) { return std::pow(x, -exponent); }, 0.01, hi);
        double sum = 0.0;
        for (double x : sample) sum -= exponent * std::log(x) + std::log(z);
        return sum;
      };
      const double top = log_likelihood(fit.alpha);
      EXPECT_NEAR(fit.log_likelihood, top, 1e-9 * std::fabs(top));
      // This is a maximum, whose curvature gives the standard error.
      const double h = 0.1 * fit.standard_error;
      const double below = log_likelihood(fit.alpha - h), above = log_likelihood(fit.alpha + h);
      EXPECT_NEAR((above - below) / (2.0 * h) * fit.standard_error, 0.0, 2e-3);
      const double curvature = (2.0 * top - above - below) / (h * h);
      EXPECT_NEAR(1.0 / std::sqrt(curvature), fit.standard_error, 2e-3 * fit.standard_error);
    }
  }
}

TEST(PowerLaw, InfiniteRangeHasTheClosedForm) {
  LSM::Random random(2);
  const auto sample = power_law_sample(500, 2.5, 3.0, infinity, random);
  const PowerLawFit fit = fit_power_law(sample, 3.0);
  double logs = 0.0;
  for (double x : sample) logs += std::log(x / 3.0);
  EXPECT_NEAR(fit.alpha, 1.0 + 500.0 / logs, 1e-12);
  EXPECT_NEAR(fit.standard_error, (fit.alpha - 1.0) / std::sqrt(500.0), 1e-12);
}

// A power law on [1, hi] as an exponential law in ln x.
Exponential law(double alpha, double hi) { return {std::log(hi), 1.0 - alpha}; }

TEST(PowerLaw, DistributionIsContinuousThroughOneAndInverts) {
  for (double hi : {2.0, 1e3, 1e12}) {
    for (double p : {0.0, 1e-9, 0.1, 0.5, 0.999}) {
      const double x = std::pow(hi, p);
      EXPECT_NEAR(law(1.0, hi).cdf(std::log(x)), p, 1e-14);
      for (double off : {1e-15, 1e-12, 1e-9, 1e-6})
        EXPECT_NEAR(law(1.0 + off, hi).cdf(std::log(x)), p, 10.0 * off + 1e-13) << hi;
      for (double alpha : {-20.0, 0.5, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5, 40.0})
        EXPECT_NEAR(law(alpha, hi).cdf(law(alpha, hi).quantile(p)), p, 1e-10) << alpha << " " << hi;
    }
  }
  EXPECT_NEAR(law(1.5, infinity).cdf(std::log(4.0)), 0.5, 1e-15);
  EXPECT_NEAR(std::exp(law(1.5, infinity).quantile(0.5)), 4.0, 1e-14);
  EXPECT_NEAR(law(2.0, 4.0).cdf(std::log(2.0)), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(law(0.0, 4.0).cdf(std::log(2.0)), 1.0 / 3.0, 1e-15);
}

TEST(PowerLaw, IntervalsCoverTheTruth) {
  LSM::Random random(3);
  struct Case {
    double alpha, lo, hi;
  };
  for (const Case &c :
       {Case{0.5, 1e-4, 1.0}, Case{1.0, 1e-4, 0.1}, Case{1.0, 1e-12, 1.0}, Case{1.0, 1.0, 3.0},
        Case{1.5, 1e-4, 1.0}, Case{2.5, 1.0, 100.0}, Case{2.5, 1.0, infinity}}) {
    Coverage coverage(c.alpha);
    for (int i = 0; i < 400; ++i) {
      const auto sample = power_law_sample(500, c.alpha, c.lo, c.hi, random);
      const PowerLawFit fit = fit_power_law(sample, c.lo, c.hi);
      ASSERT_FALSE(fit.degenerate) << fit.why;
      coverage.add(fit.alpha, fit.standard_error);
    }
    coverage.expect("alpha " + std::to_string(c.alpha) + " to " + std::to_string(c.hi));
  }
}

TEST(PowerLaw, ValuesOutsideTheRangeDoNotCount) {
  LSM::Random random(4);
  auto sample = power_law_sample(400, 1.2, 1.0, 100.0, random);
  const PowerLawFit alone = fit_power_law(sample, 1.0, 100.0);
  sample.insert(sample.begin(), {-3.0, 0.0, 0.1, 0.99});
  sample.insert(sample.end(), {100.5, 1e6});
  const PowerLawFit fit = fit_power_law(sample, 1.0, 100.0);
  EXPECT_EQ(fit.n, 400);
  EXPECT_EQ(fit.alpha, alone.alpha);
  EXPECT_EQ(fit.ks, alone.ks);
}

TEST(PowerLaw, DistanceIsThatOfEveryPoint) {
  LSM::Random random(5);
  for (std::size_t n : {10u, 11u, 100u, 101u, 5000u, 5001u}) {
    for (double alpha : {0.5, 1.0, 2.0}) {
      // Values are rounded down or up, so that there are ties, and either distribution function can
      // be the larger one.
      auto sample = power_law_sample(n, alpha, 1.0, 50.0, random);
      for (double &x : sample) x = (n % 2 == 0 ? std::floor(4.0 * x) : std::ceil(4.0 * x)) / 4.0;
      const PowerLawFit fit = fit_power_law(sample, 1.0, 50.0);
      double distance = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double f = law(fit.alpha, 50.0).cdf(std::log(sample[i]));
        const auto rank = static_cast<double>(i), count = static_cast<double>(n);
        distance = std::max({distance, f - rank / count, (rank + 1.0) / count - f});
      }
      EXPECT_NEAR(fit.ks, distance, 1e-13);
    }
  }
}

void expect_degenerate(const PowerLawFit &fit, const std::string &why) {
  EXPECT_TRUE(fit.degenerate);
  EXPECT_TRUE(std::isnan(fit.alpha));
  EXPECT_TRUE(std::isnan(fit.standard_error));
  EXPECT_TRUE(std::isnan(fit.ks));
  EXPECT_NE(fit.why.find(why), std::string::npos) << fit.why;
}

TEST(PowerLaw, DegenerateFitsGiveNoNumber) {
  expect_degenerate(fit_power_law({1, 2, 3, 4, 5, 6, 7, 8, 9}, 1.0, 10.0), "9 events");
  expect_degenerate(fit_power_law({}, 1.0, 10.0), "0 events");
  expect_degenerate(fit_power_law(std::vector<double>(50, 3.0), 1.0, 10.0), "same size");
  LSM::Random random(6);
  const auto narrow = power_law_sample(50, 1.0, 1.0, 1.05, random);
  expect_degenerate(fit_power_law(narrow, 1.0, 1.05), "too narrow");
  const PowerLawFit none = fit_power_law(narrow, 1.0, 1.05);
  EXPECT_THROW(p_value(none, narrow, 10, 1), std::invalid_argument);
  EXPECT_THROW(compare(narrow, none), std::invalid_argument);
}

TEST(PowerLaw, RefusesImpossibleInput) {
  const std::vector<double> sample(20, 1.0);
  EXPECT_THROW(fit_power_law({2.0, 1.0}, 1.0, 3.0), std::invalid_argument);
  EXPECT_THROW(fit_power_law(sample, 0.0, 3.0), std::invalid_argument);
  EXPECT_THROW(fit_power_law(sample, 3.0, 3.0), std::invalid_argument);
  EXPECT_THROW(fit_power_law(sample, std::nan(""), 3.0), std::invalid_argument);
}

// Expects p(seed) to be at most 0.1 and 0.5 as often as these say.
void expect_reliable(const std::function<double(std::uint64_t)> &p) {
  constexpr int trials = 200;
  int below_tenth = 0, below_half = 0;
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const double found = p(seed);
    below_tenth += found <= 0.1;
    below_half += found <= 0.5;
  }
  expect_binomial(below_tenth, trials, 0.1, "0.1");
  expect_binomial(below_half, trials, 0.5, "0.5");
}

TEST(PowerLaw, ProbabilityIsUniformUnderTheNull) {
  LSM::Random random(7);
  for (double alpha : {1.0, 2.0}) {
    std::vector<double> p;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const auto sample = power_law_sample(100, alpha, 1.0, 1e3, random);
      p.push_back(p_value(fit_power_law(sample, 1.0, 1e3), sample, 99, i + 1));
    }
    std::sort(p.begin(), p.end());
    // p takes the values 0.01 ... 1; the 0.3 % point of the distance is 1.8 / sqrt(300).
    const double distance = Sample(p).distance([](double x) { return x - 0.005; });
    EXPECT_LT(distance, 1.8 / std::sqrt(300.0));
  }
}

// The comparison used for replicas agrees with that of the distances themselves, even if these are
// equal.
TEST(Sample, ComparisonAgreesWithTheDistance) {
  LSM::Random random(3);
  const auto uniform = [](double x) { return x; };
  int as_far = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(300);
    for (double &x : values) x = random.uniform();
    Sample sample(values);
    sample.sort();
    const double distance = sample.distance(uniform);
    EXPECT_TRUE(sample.is_as_far(uniform, distance));
    EXPECT_FALSE(sample.is_as_far(uniform, std::nextafter(distance, 1.0)));
    EXPECT_TRUE(sample.is_as_far(uniform, std::nextafter(distance, 0.0)));
    const double other = 0.05;  // exceeded by about a third of the samples
    EXPECT_EQ(sample.is_as_far(uniform, other), distance >= other);
    as_far += distance >= other;
  }
  EXPECT_GT(as_far, 20);
  EXPECT_LT(as_far, 180);
}

// The test of large samples uses counts in cells: its p is as reliable as that from single values,
// and its power no less.
TEST(PowerLaw, ProbabilityOfManyValues) {
  LSM::Random random(12);
  const std::size_t n = 12000;
  ASSERT_GT(n, largest_exact_sample);
  expect_reliable([&](std::uint64_t seed) {
    const std::vector<double> sample = power_law_sample(n, 1.3, 1.0, 1e3, random);
    return p_value(fit_power_law(sample, 1.0, 1e3), sample, 39, seed);
  });
  // One in ten is from another law: detected in 12000 values, but in 1200 of them no more often
  // than by chance.
  std::vector<double> mixed = power_law_sample(n - n / 10, 1.3, 1.0, 1e3, random);
  const std::vector<double> other = power_law_sample(n / 10, 2.5, 1.0, 1e3, random);
  mixed.insert(mixed.end(), other.begin(), other.end());
  std::sort(mixed.begin(), mixed.end());
  EXPECT_LT(p_value(fit_power_law(mixed, 1.0, 1e3), mixed, 99, 1), 0.03);
}

// The ratios are recomputed from the parameters alone, with every density normalised by quadrature.
TEST(PowerLaw, RatiosAgreeWithQuadrature) {
  LSM::Random random(10);
  int two_sided = 0;
  struct Case {
    double alpha, cut_off, lo, hi;
  };
  for (const Case &c : {Case{0.6, 0.3, 1e-4, 1.0}, Case{1.0, 0.05, 1e-4, 1.0},
                        Case{1.8, 2.0, 0.01, 1e3}, Case{2.5, 5.0, 1.0, infinity}}) {
    // A power law with an exponential cut-off, sampled by rejection.
    std::vector<double> sample;
    while (sample.size() < 3000) {
      const double x = power_law_sample(1, c.alpha, c.lo, c.hi, random)[0];
      if (random.uniform() < std::exp(-x / c.cut_off)) sample.push_back(x);
    }
    std::sort(sample.begin(), sample.end());
    const PowerLawFit fit = fit_power_law(sample, c.lo, c.hi);
    ASSERT_FALSE(fit.degenerate) << fit.why;
    const double log_power_law_z = std::log(
        integrate([&](double x) { return std::pow(x, -fit.alpha); }, c.lo, std::min(c.hi, 1e12)));
    for (const Comparison &comparison : compare(sample, fit)) {
      ASSERT_FALSE(comparison.degenerate) << comparison.rival << comparison.why;
      std::map<std::string, double> p;
      for (const auto &[name, value] : comparison.parameters) p[name] = value;
      const auto log_density = [&](double x) {
        if (comparison.rival == "exponential") return -p["rate"] * x;
        if (comparison.rival == "log-normal")
          return -std::log(x) - 0.5 * std::pow((std::log(x) - p["mu"]) / p["sigma"], 2);
        return -p["alpha"] * std::log(x) - x / p["cut-off"];
      };
      // On the infinite range, all alternatives are negligible beyond this.
      const double end = c.hi < infinity ? c.hi : 1e12;
      const double shift = log_density(sample[sample.size() / 2]);
      const double log_z =
          shift + std::log(integrate([&](double x) { return std::exp(log_density(x) - shift); },
                                     c.lo, end));
      double rival = 0.0, squares = 0.0;
      for (double x : sample) {
        rival += log_density(x) - log_z;
        const double ours = -fit.alpha * std::log(x) - log_power_law_z;
        squares += std::pow(ours - (log_density(x) - log_z), 2);
      }
      EXPECT_NEAR(comparison.log_likelihood_ratio, fit.log_likelihood - rival,
                  1e-6 * std::fabs(rival) / 1000.0)
          << comparison.rival << " " << c.alpha;
      if (comparison.rival == "power law with exponential cut-off") {
        EXPECT_LT(comparison.p, 1e-6);
        EXPECT_NEAR(p["alpha"], c.alpha, 0.12);
        EXPECT_NEAR(std::log(p["cut-off"] / c.cut_off), 0.0, 0.6);
      } else {
        // Vuong's test: the sum over its standard deviation is compared with a normal law,
        // two-sided.
        const auto n = static_cast<double>(sample.size());
        const double mean = comparison.log_likelihood_ratio / n;
        const double z = std::sqrt(n) * mean / std::sqrt(squares / n - mean * mean);
        EXPECT_NEAR(comparison.normalised / z, 1.0, 1e-4) << comparison.rival << " " << c.alpha;
        const double expected = 2.0 * gsl_cdf_ugaussian_Q(std::fabs(comparison.normalised));
        if (expected < 1e-200) continue;
        EXPECT_NEAR(comparison.p / expected, 1.0, 1e-9) << comparison.rival << " " << c.alpha;
        ++two_sided;
      }
    }
  }
  EXPECT_GE(two_sided, 3);
}

// ---------------------------------------------------------------- sizes in bins

// Sizes of the law on the bins first to last (0: no last one), each moved to the centre of its bin.
std::vector<double> sample_in_bins(int n, double alpha, double step, int first, int last,
                                   LSM::Random &random) {
  const double lo = std::exp((first - 0.5) * step);
  std::vector<double> sample =
      power_law_sample(n, alpha, lo, last > 0 ? std::exp((last + 0.5) * step) : infinity, random);
  for (double &x : sample) x = std::exp(step * std::floor(std::log(x) / step + 0.5));
  return sample;
}

constexpr double tenth = 0.3453877639491069;  // of a magnitude: 0.1 x 1.5 ln 10

TEST(PowerLaw, ExponentOfSizesInBins) {
  LSM::Random random(41);
  struct Case {
    double alpha, step;
    int first, last;
  };
  for (const Case &c :
       {Case{1.67, tenth, 20, 40}, Case{1.67, 2.0 * tenth, 10, 0}, Case{0.8, tenth, -5, 15},
        Case{1.0, 0.1 * tenth, 200, 400}, Case{2.5, 5.0 * tenth, 4, 0}}) {
    Coverage coverage(c.alpha);
    double naive = 0.0, mean = 0.0;
    const double lo = std::exp(c.first * c.step),
                 hi = c.last > 0 ? std::exp(c.last * c.step) : infinity;
    for (int i = 0; i < 300; ++i) {
      const auto sample = sample_in_bins(400, c.alpha, c.step, c.first, c.last, random);
      const PowerLawFit fit = fit_power_law(sample, lo, hi, c.step);
      ASSERT_FALSE(fit.degenerate) << fit.why;
      ASSERT_EQ(fit.n, 400);
      EXPECT_EQ(fit.lo, lo);
      coverage.add(fit.alpha, fit.standard_error);
      mean += fit.alpha / 300.0;
      naive += fit_power_law(sample, lo, hi).alpha / 300.0;
    }
    coverage.expect("alpha = " + std::to_string(c.alpha) + ", step " + std::to_string(c.step));
    // Taken for continuous, sizes in wide bins have another exponent.
    if (c.step > 0.3 && c.alpha > 1.5) {
      EXPECT_GT(naive, mean + 0.05);
    }
  }
}

TEST(PowerLaw, RangesInBins) {
  LSM::Random random(43);
  const auto sample = sample_in_bins(2000, 1.67, tenth, 20, 60, random);
  const PowerLawFit fit = fit_power_law(sample, 1000.0, 1e6, tenth);
  EXPECT_EQ(fit.lo, 1000.0);
  EXPECT_NEAR(fit.lower_end(), std::pow(10.0, 1.5 * 1.95), 1e-9);
  EXPECT_NEAR(fit.upper_end(), std::pow(10.0, 1.5 * 4.05), 1e-6);
  // Ends between the centres of bins move to the next ones inside.
  const PowerLawFit inside = fit_power_law(sample, 750.0, 1.3e6, tenth);
  EXPECT_EQ(inside.alpha, fit.alpha);
  EXPECT_EQ(inside.n, fit.n);
  // Where there are no events, the law extends over the range all the same.
  const PowerLawFit longer = fit_power_law(sample, 10.0, 1e12, tenth);
  EXPECT_LT(longer.alpha, fit.alpha - 3.0 * fit.standard_error);
  expect_degenerate(fit_power_law(sample, 1000.0, 1100.0, tenth), "fewer than two bins");
  // Three decades are 200 bins of 0.01 but for rounding: the last one, at M 6, belongs to the law.
  const double hundredth = std::log(std::pow(10.0, 1.5 * 0.01));
  const auto fine = sample_in_bins(500, 1.67, hundredth, 400, 600, random);
  const PowerLawFit all = fit_power_law(fine, 1e6, 1e9, hundredth);
  ASSERT_EQ(all.n, 500);
  double mean = 0.0, of_law = 0.0, total = 0.0;
  for (const double x : fine) mean += std::log(x) / hundredth / 500.0;
  for (int bin = 400; bin <= 600; ++bin) {
    const double p = std::exp((1.0 - all.alpha) * hundredth * (bin - 400));
    of_law += p * bin;
    total += p;
  }
  EXPECT_NEAR(of_law / total, mean, 1e-8);
  expect_degenerate(fit_power_law(std::vector<double>(50, 1000.0), 1000.0, 1e6, tenth),
                    "same size");
}

TEST(PowerLaw, ProbabilityOfSizesInBinsIsUniformUnderTheNull) {
  LSM::Random random(44);
  for (const int last : {45, 0})
    expect_reliable([&](std::uint64_t seed) {
      const auto sample = sample_in_bins(1500, 1.67, tenth, 20, last, random);
      const double hi = last > 0 ? std::exp(last * tenth) : infinity;
      return p_value(fit_power_law(sample, 1000.0, hi, tenth), sample, 39, seed);
    });
  // Another law is found out; as continuous sizes, even the right one is rejected.
  auto mixed = sample_in_bins(1000, 1.3, tenth, 20, 45, random);
  const auto other = sample_in_bins(1000, 2.5, tenth, 20, 45, random);
  mixed.insert(mixed.end(), other.begin(), other.end());
  std::sort(mixed.begin(), mixed.end());
  EXPECT_LT(p_value(fit_power_law(mixed, 1000.0, 3e6, tenth), mixed, 99, 1), 0.03);
  const auto right = sample_in_bins(2000, 1.67, tenth, 20, 45, random);
  EXPECT_EQ(p_value(fit_power_law(right, 1000.0, 3e6), right, 99, 1), 0.01);
}

TEST(PowerLaw, CutOffIsNotFoundWhereThereIsNone) {
  LSM::Random random(12);
  int none = 0, significant = 0;
  for (int i = 0; i < 300; ++i) {
    const auto sample = power_law_sample(1000, 1.2, 1e-3, 1.0, random);
    const Comparison cut_off = compare(sample, fit_power_law(sample, 1e-3, 1.0))[2];
    if (cut_off.degenerate) {
      ++none;
      EXPECT_TRUE(cut_off.parameters.empty());
      EXPECT_NE(cut_off.why.find("the power law itself"), std::string::npos) << cut_off.why;
      EXPECT_EQ(cut_off.p, 1.0);
    } else if (cut_off.p < 0.05) {
      ++significant;
    }
  }
  // As the true parameter is at the border of its range, half of the samples prefer the power law
  // itself, and the others are significant half as often as p states.
  expect_binomial(none, 300, 0.5, "no cut-off");
  expect_binomial(significant, 300, 0.025, "cut-off with p < 0.05");
}

}  // namespace
