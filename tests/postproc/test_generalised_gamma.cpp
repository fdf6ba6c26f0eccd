// SPDX-License-Identifier: GPL-2.0-or-later
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sf.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "coverage.h"
#include "generalised_gamma.h"
#include "log_histogram.h"
#include "monte_carlo.h"
#include "size_fits.h"

namespace {

using namespace LSM::postproc;

struct Truth {
  double gamma, delta, B;
  double c() const { return delta / (std::pow(B, gamma / delta) * std::tgamma(gamma / delta)); }
};

// Table 1 of the paper: Corral's universal law, with delta = 1.
constexpr Truth corral{0.7, 1.0, 1.58};

// Samples by GSL, independent of the code under test: theta^delta is gamma distributed.
class Source {
 public:
  explicit Source(unsigned long seed) : rng_(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free) {
    gsl_rng_set(rng_.get(), seed);
  }
  std::vector<double> sample(std::size_t n, const Truth &t, double lo = 0.0) {
    std::vector<double> values;
    while (values.size() < n) {
      const double w = gsl_ran_gamma(rng_.get(), t.gamma / t.delta, t.B);
      const double theta = std::pow(w, 1.0 / t.delta);
      if (theta >= lo && theta > 0.0) values.push_back(theta);
    }
    return values;
  }
  // theta^-1 exp(-theta / B) above lo (gamma = 0, delta = 1): log-uniform numbers, of which some
  // are rejected.
  std::vector<double> sample_gamma_zero(std::size_t n, double B, double lo) {
    std::vector<double> values;
    while (values.size() < n) {
      const double theta = lo * std::pow(60.0 * B / lo, gsl_rng_uniform(rng_.get()));
      if (gsl_rng_uniform(rng_.get()) < std::exp(-theta / B)) values.push_back(theta);
    }
    return values;
  }
  std::vector<double> power_law(std::size_t n, double alpha, double hi) {
    std::vector<double> values;
    while (values.size() < n) {
      const double x = gsl_ran_pareto(rng_.get(), alpha - 1.0, 1.0);
      if (x <= hi) values.push_back(x);
    }
    return values;
  }

 private:
  std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> rng_;
};

// The fixed value of delta.
double held_at_one(bool fixed) { return fixed ? 1.0 : NAN; }

// Log-likelihood by GSL, normalised in closed form, or by quadrature above lo.
double log_likelihood(const std::vector<double> &values, const Truth &t, double lo) {
  double z = 1.0 / t.c();
  if (lo > 0.0) {
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(1000);
    gsl_function function;
    function.params = const_cast<Truth *>(&t);
    function.function = [](double v, void *p) {
      const auto &truth = *static_cast<const Truth *>(p);
      return std::exp(truth.gamma * v - std::exp(truth.delta * v) / truth.B);
    };
    double error = 0.0;
    gsl_integration_qagiu(&function, std::log(lo), 0.0, 1e-12, 1000, work, &z, &error);
    gsl_integration_workspace_free(work);
  }
  double sum = 0.0;
  for (double x : values)
    sum += (t.gamma - 1.0) * std::log(x) - std::pow(x, t.delta) / t.B - std::log(z);
  return sum;
}

TEST(GeneralisedGamma, MaximumOfAnIndependentLikelihood) {
  Source source(1);
  for (double lo : {0.0, 0.05}) {
    for (const Truth &truth : {corral, Truth{1.5, 0.8, 1.0}, Truth{0.9, 1.5, 4.0}}) {
      const auto values = source.sample(3000, truth, lo);
      for (const bool fixed : {false, true}) {
        const GeneralisedGammaFit fit = fit_maximum_likelihood(values, lo, held_at_one(fixed));
        ASSERT_FALSE(fit.degenerate) << fit.why;
        const Truth best{fit.gamma, fit.delta, fit.B};
        const double top = log_likelihood(values, best, lo);
        EXPECT_NEAR(fit.log_likelihood, top, 1e-9 * std::fabs(top));
        if (lo == 0.0) {
          EXPECT_NEAR(fit.C, best.c(), 1e-9 * fit.C);
        }
        // In each parameter the likelihood falls on both sides, equally (its slope is zero).
        for (int i = 0; i < (fixed ? 2 : 3); ++i) {
          const double step = 0.02 * (i == 0 ? fit.se_gamma : i == 1 ? fit.se_B : fit.se_delta);
          Truth up = best, down = best;
          (i == 0 ? up.gamma : i == 1 ? up.B : up.delta) += step;
          (i == 0 ? down.gamma : i == 1 ? down.B : down.delta) -= step;
          const double above = log_likelihood(values, up, lo) - top;
          const double below = log_likelihood(values, down, lo) - top;
          EXPECT_LT(above, 0.0);
          EXPECT_LT(below, 0.0);
          EXPECT_NEAR(above / below, 1.0, 0.1) << i << " " << lo << " " << truth.gamma;
        }
      }
    }
  }
}

TEST(GeneralisedGamma, LikelihoodIntervalsCoverTheTruth) {
  Source source(4);
  struct Case {
    Truth truth;
    double lo;
    bool fixed;
    std::size_t n;
  };
  // Samples are large where delta is free, as B is far from normal in small ones.
  for (const Case &c :
       {Case{corral, 0.0, true, 500}, Case{corral, 0.02, true, 1000},
        Case{{1.0, 1.0, 600.0}, 0.0, true, 500}, Case{corral, 0.0, false, 4000},
        Case{{2.0, 1.5, 1.2}, 0.0, false, 4000}, Case{corral, 0.02, false, 10000}}) {
    Coverage gamma(c.truth.gamma), delta(c.truth.delta), b(c.truth.B), norm(c.truth.c());
    for (int i = 0; i < 300; ++i) {
      const GeneralisedGammaFit fit =
          fit_maximum_likelihood(source.sample(c.n, c.truth, c.lo), c.lo, held_at_one(c.fixed));
      ASSERT_FALSE(fit.degenerate) << fit.why;
      gamma.add(fit.gamma, fit.se_gamma);
      b.add(fit.B, fit.se_B);
      if (!c.fixed) delta.add(fit.delta, fit.se_delta);
      if (c.lo == 0.0) norm.add(fit.C, fit.se_C);
    }
    const std::string what = " gamma " + std::to_string(c.truth.gamma) + " lo " +
                             std::to_string(c.lo) + (c.fixed ? " delta = 1" : " delta free");
    gamma.expect("gamma," + what);
    b.expect("B," + what);
    if (!c.fixed) delta.expect("delta," + what);
    if (c.lo == 0.0) norm.expect("C," + what);
  }
}

TEST(GeneralisedGamma, GammaZeroNeedsTruncation) {
  // The block-slider's law in Table 1.
  Source source(5);
  Coverage gamma(0.0), b(100.0);
  for (int i = 0; i < 300; ++i) {
    const auto values = source.sample_gamma_zero(1000, 100.0, 0.5);
    const GeneralisedGammaFit fit = fit_maximum_likelihood(values, 0.5, 1.0);
    ASSERT_FALSE(fit.degenerate) << fit.why;
    gamma.add(fit.gamma, fit.se_gamma);
    b.add(fit.B, fit.se_B);
    if (i > 0) continue;
    // C over [lo, infinity) is 1 / E1(lo / B) for gamma = 0.
    EXPECT_NEAR(fit.C, 1.0 / gsl_sf_expint_E1(0.005), 4.0 * fit.se_C);
    EXPECT_GT(p_value(fit, values, 20, 1), 0.05);
  }
  gamma.expect("gamma = 0");
  b.expect("B, gamma = 0");

  // Without truncation the fit ends at gamma = 0 if there are too many small times.
  const auto values = source.sample_gamma_zero(5000, 1e6, 1e-30);
  const GeneralisedGammaFit fit = fit_maximum_likelihood(values, 0.0, 1.0);
  EXPECT_TRUE(fit.degenerate);
  EXPECT_NE(fit.why.find("truncated on the left"), std::string::npos) << fit.why;
}

TEST(GeneralisedGamma, LeastSquaresIsNearlyUnbiasedAndItsErrorsAreRight) {
  Source source(6);
  const Truth truth{0.7, 1.0, 60.0};
  for (const bool fixed : {false, true}) {
    double gamma = 0.0, b = 0.0, gamma_squared = 0.0, c = 0.0, c_squared = 0.0;
    constexpr int trials = 200;
    for (int i = 0; i < trials; ++i) {
      const GeneralisedGammaFit fit =
          fit_least_squares(log_histogram(source.sample(20000, truth)), held_at_one(fixed));
      ASSERT_FALSE(fit.degenerate) << fit.why;
      const double pull = (fit.gamma - truth.gamma) / fit.se_gamma;
      const double pull_c = std::log(fit.C / truth.c()) / (fit.se_C / fit.C);
      gamma += pull / trials;
      gamma_squared += pull * pull / trials;
      b += std::log(fit.B / truth.B) / (fit.se_B / fit.B) / trials;
      c += pull_c / trials;
      c_squared += pull_c * pull_c / trials;
    }
    // Without the added half count the mean pulls would be -0.6 and 0.3 or more.
    EXPECT_LT(std::fabs(gamma), 0.45);
    EXPECT_LT(std::fabs(b), 0.3);
    EXPECT_NEAR(std::sqrt(gamma_squared - gamma * gamma), 1.0, 0.15);
    EXPECT_NEAR(std::sqrt(c_squared - c * c), 1.0, 0.15);
  }
}

TEST(GeneralisedGamma, ErrorsComeFromTheObservedInformation) {
  // For data of another law, observed and expected information differ. The reference is second
  // differences of an independent likelihood.
  Source source(12);
  auto values = source.sample(3000, corral);
  for (double value : source.sample(1000, {2.0, 1.0, 3.0})) values.push_back(value);
  const GeneralisedGammaFit fit = fit_maximum_likelihood(values);
  ASSERT_FALSE(fit.degenerate) << fit.why;
  const double step[3] = {0.05 * fit.se_gamma, 0.05 * fit.se_delta, 0.05 * fit.se_B};
  const auto at = [&](int i, double u, int j, double v) {
    double p[3] = {fit.gamma, fit.delta, fit.B};
    p[i] += u * step[i];
    p[j] += v * step[j];
    return log_likelihood(values, {p[0], p[1], p[2]}, 0.0);
  };
  double h[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      h[i][j] = -(at(i, 1, j, 1) - at(i, 1, j, -1) - at(i, -1, j, 1) + at(i, -1, j, -1)) / 4.0 /
                (step[i] * step[j]);
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return h[a][c] * h[b][d] - h[a][d] * h[b][c];
  };
  const double determinant = h[0][0] * minor(0, 0) + h[0][1] * minor(0, 1) + h[0][2] * minor(0, 2);
  EXPECT_NEAR(fit.se_gamma / std::sqrt(minor(0, 0) / determinant), 1.0, 0.01);
  EXPECT_NEAR(fit.se_delta / std::sqrt(minor(1, 1) / determinant), 1.0, 0.01);
  EXPECT_NEAR(fit.se_B / std::sqrt(minor(2, 2) / determinant), 1.0, 0.01);
}

void expect_degenerate(const GeneralisedGammaFit &fit, const std::string &why) {
  EXPECT_TRUE(fit.degenerate) << why;
  for (double value : {fit.C, fit.gamma, fit.delta, fit.B, fit.se_C, fit.se_gamma, fit.se_B})
    EXPECT_TRUE(std::isnan(value)) << why;
  EXPECT_NE(fit.why.find(why), std::string::npos) << fit.why;
}

TEST(GeneralisedGamma, PowerLawIsDegenerate) {
  Source source(8);
  // At a level of 95 %, 2 of 40 samples show a fall-off by chance; 8 would have a chance of 10^-3.
  int likelihood = 0, squares = 0;
  for (int i = 0; i < 40; ++i) {
    const auto values = source.power_law(2000, 1.5, HUGE_VAL);
    if (!fit_maximum_likelihood(values, 1.0).degenerate) ++likelihood;
    if (!fit_least_squares(log_histogram(values)).degenerate) ++squares;
    if (!fit_maximum_likelihood(values, 1.0, 1.0).degenerate) ++likelihood;
  }
  EXPECT_LE(likelihood, 8);
  EXPECT_LE(squares, 8);
  const auto values = source.power_law(20000, 1.5, HUGE_VAL);
  expect_degenerate(fit_maximum_likelihood(values, 1.0), "no exponential fall-off");
  expect_degenerate(fit_least_squares(log_histogram(values)), "no exponential fall-off");
  // Without truncation, delta reaches its lower limit.
  expect_degenerate(fit_maximum_likelihood(values), "delta runs below 0.1");
  // A sharp end of the distribution is no exponential fall-off.
  expect_degenerate(fit_maximum_likelihood(source.power_law(20000, 1.1, 1e4), 1.0),
                    "delta runs above 10");
}

TEST(GeneralisedGamma, FewEventsAreDegenerate) {
  Source source(9);
  int free = 0, fixed = 0;
  for (int i = 0; i < 50; ++i) {
    const auto values = source.sample(30, corral);
    if (fit_maximum_likelihood(values).degenerate) ++free;
    if (!fit_maximum_likelihood(values, 0.0, 1.0).degenerate) ++fixed;
    EXPECT_TRUE(fit_least_squares(log_histogram(values)).degenerate);
  }
  EXPECT_GE(free, 48);   // 30 values never determine three parameters
  EXPECT_GE(fixed, 40);  // but they determine two
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(fit_maximum_likelihood(source.sample(5000, corral)).degenerate);
  // In between, some fits are not degenerate, and these are what the header promises.
  int shown = 0;
  for (int i = 0; i < 100; ++i) {
    const GeneralisedGammaFit fit = fit_maximum_likelihood(source.sample(200, corral));
    if (fit.degenerate) continue;
    ++shown;
    EXPECT_LE(fit.se_gamma, 0.25 * std::max(1.0, fit.gamma));
    EXPECT_LE(fit.se_delta, 0.25 * fit.delta);
    EXPECT_LE(fit.se_B, fit.B);
  }
  EXPECT_GT(shown, 5);
  EXPECT_LT(shown, 95);
  expect_degenerate(fit_maximum_likelihood(source.sample(19, corral)), "19 values");
  expect_degenerate(fit_maximum_likelihood({}), "0 values");
  expect_degenerate(fit_maximum_likelihood(std::vector<double>(100, 2.0)), "equal");
  expect_degenerate(fit_least_squares({}), "0 bins");
  expect_degenerate(fit_least_squares(log_histogram(std::vector<double>(100, 2.0))), "1 bins");
}

TEST(GeneralisedGamma, WrongLawShows) {
  Source source(10);
  const auto values = source.sample(5000, {0.7, 0.5, 3.0});
  const GeneralisedGammaFit fit = fit_maximum_likelihood(values, 0.0, 1.0);
  ASSERT_FALSE(fit.degenerate);
  EXPECT_EQ(p_value(fit, values, 40, 1), 1.0 / 41.0);
  const GeneralisedGammaFit squares = fit_least_squares(log_histogram(values), 1.0);
  EXPECT_GT(squares.chi2, 2.0 * squares.dof);
  EXPECT_LT(p_value(squares, {}, 0, 1), 1e-6);
}

// Number of samples that are rejected at 5 %.
struct Rejections {
  int trials = 0;
  int by_monte_carlo = 0;       // p_value()
  int upper_half = 0;           // p above one half
  int binned = 0, by_chi2 = 0;  // samples that least squares can fit, and p_value() of these
};
constexpr int test_replicas = 40;

template <class Draw>
Rejections rejections(int trials, double lo, double held, Draw draw) {
  Rejections count;
  while (count.trials < trials) {
    const std::vector<double> values = draw();
    const GeneralisedGammaFit fit = fit_maximum_likelihood(values, lo, held);
    const GeneralisedGammaFit squares = fit_least_squares(log_histogram(values), held);
    EXPECT_FALSE(fit.degenerate) << fit.why;
    if (fit.degenerate) break;
    ++count.trials;
    const double p = p_value(fit, values, test_replicas, static_cast<std::uint64_t>(count.trials));
    if (p < 0.05) ++count.by_monte_carlo;
    if (p > 0.5) ++count.upper_half;
    if (squares.degenerate) continue;
    ++count.binned;
    if (p_value(squares, {}, 0, 1) < 0.05) ++count.by_chi2;
  }
  return count;
}

TEST(GoodnessOfFit, ATrueLawIsRejectedAtTheNominalRate) {
  Source source(13);
  struct Case {
    Truth truth;
    double lo;
    bool fixed;
    std::size_t n;
    int trials;
  };
  // Shares of 41 equally probable ranks with p below 0.05, and with p above 0.5.
  const double nominal = 2.0 / 41.0, half = 21.0 / 41.0;
  for (const Case &c :
       {Case{corral, 0.0, true, 400, 400}, Case{{2.0, 1.0, 600.0}, 0.0, true, 400, 400},
        Case{corral, 0.02, true, 600, 150}, Case{corral, 0.0, false, 2000, 80}}) {
    const Rejections count = rejections(c.trials, c.lo, held_at_one(c.fixed),
                                        [&] { return source.sample(c.n, c.truth, c.lo); });
    const std::string what =
        "gamma " + std::to_string(c.truth.gamma) + ", lo " + std::to_string(c.lo);
    expect_binomial(count.by_monte_carlo, count.trials, nominal, what);
    expect_binomial(count.upper_half, count.trials, half, what + ", p above one half");
    EXPECT_GT(count.binned, 0.9 * count.trials) << what;
    if (c.lo == 0.0) expect_binomial(count.by_chi2, count.binned, 0.05, what + ", least squares");
  }
  // gamma = 0, for which the density exists only above some time.
  const Rejections count =
      rejections(120, 0.5, 1.0, [&] { return source.sample_gamma_zero(600, 100.0, 0.5); });
  expect_binomial(count.by_monte_carlo, count.trials, nominal, "gamma = 0");
}

TEST(GoodnessOfFit, NumberOfCoresDoesNotMatter) {
  Source source(5);
  const std::vector<double> few = source.sample(200, corral), many = source.sample(9000, corral);
  const auto p = [](const std::vector<double> &values) {
    return p_value(fit_maximum_likelihood(values), values, 50, 3);
  };
  const double p_few = p(few), p_many = p(many);
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(p(few), p_few);
  EXPECT_EQ(p(many), p_many);
  sched_setaffinity(0, sizeof before, &before);
}

TEST(Replicas, EachOnceAndErrorsAreHandedOn) {
  std::vector<int> calls(1000);
  for_each_replica(1000, [&calls](int k) { ++calls[static_cast<std::size_t>(k)]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
  for_each_replica(0, [](int) { FAIL(); });
  EXPECT_THROW(for_each_replica(10,
                                [](int k) {
                                  if (k == 7) throw std::runtime_error("seven");
                                }),
               std::runtime_error);
  EXPECT_NE(seed_of_replica(1, 1), seed_of_replica(2, 0));
}

TEST(GoodnessOfFit, SeedAndReplicas) {
  Source source(15);
  const std::vector<double> values = source.sample(500, corral);
  const GeneralisedGammaFit fit = fit_maximum_likelihood(values, 0, 1.0);
  const double p = p_value(fit, values, 200, 7);
  EXPECT_EQ(p_value(fit, values, 200, 7), p);
  EXPECT_NE(p_value(fit, values, 200, 8), p);
  EXPECT_NEAR(p_value(fit, values, 200, 8), p, 5.0 * std::sqrt(p * (1.0 - p) / 200.0));
  EXPECT_TRUE(std::isnan(p_value(fit, values, 0, 7)));
  EXPECT_THROW(p_value(fit_maximum_likelihood({}), {}, 10, 7), std::invalid_argument);
}

TEST(GeneralisedGamma, RefusesImpossibleInput) {
  const std::vector<double> good(30, 1.0);
  for (double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    std::vector<double> values = good;
    values.push_back(bad);
    EXPECT_THROW(fit_maximum_likelihood(values), std::invalid_argument) << bad;
  }
  EXPECT_NO_THROW(fit_maximum_likelihood({0.0, 1.0}, 0.5));
  EXPECT_THROW(fit_maximum_likelihood(good, 0.0, 0.0), std::invalid_argument);
}

// From no starting point is the sum of squares finite.
TEST(GeneralisedGamma, InfiniteDensityHasNoOptimum) {
  std::vector<LogBin> bins;
  for (double lo = 1.0; lo < 100.0; lo *= 2.0)
    bins.push_back({lo, 2.0 * lo, std::sqrt(2.0) * lo, 50, 1.0 / lo, 0.1 / lo});
  bins.front().density = HUGE_VAL;
  for (const bool fixed : {false, true}) {
    const GeneralisedGammaFit fit = fit_least_squares(bins, held_at_one(fixed));
    EXPECT_TRUE(fit.degenerate);
    EXPECT_EQ(fit.why, "no optimum found");
  }
}

TEST(GeneralisedGamma, ErrorHandlerOfGslIsLeftAlone) {
  gsl_error_handler_t *const mine = [](const char *, const char *, int, int) {};
  gsl_error_handler_t *const before = gsl_set_error_handler(mine);
  Source source(11);
  fit_maximum_likelihood(source.sample(100, corral));
  fit_least_squares(log_histogram(source.sample(100, corral)));
  EXPECT_EQ(gsl_set_error_handler(before), mine);
}

TEST(RollOff, FindsItsPower) {
  // s^-1.2 exp(-(s / 0.1)^power) above 1e-4, sampled by rejection from a power law up to 10.
  for (const double power : {1.0, 2.5}) {
    LSM::Random random(29);
    EventTable table;
    while (table.events.size() < 8000) {
      const double lo = std::pow(1e-4, -0.2), hi = std::pow(10.0, -0.2);
      const double size = std::pow(lo + random.uniform() * (hi - lo), -5.0);
      if (random.uniform() > std::exp(-std::pow(size / 0.1, power))) continue;
      LSM::EventSummary shock;
      shock.size = size;
      table.events.push_back(shock);
    }
    const RollOff fit = roll_off(table, 1e-4);
    ASSERT_FALSE(fit.free.degenerate) << fit.free.why;
    EXPECT_NEAR(fit.free.delta, power, 3.0 * fit.free.se_delta);
    EXPECT_LT(fit.free.se_delta, 0.3 * power);
    EXPECT_NEAR(1.0 - fit.free.gamma, 1.2, 4.0 * fit.free.se_gamma);
    EXPECT_GT(fit.gain, 100.0);
  }
}

TEST(RollOff, GainOfAPowerLawIsThatOfChance) {
  // Twice the gain in ln L of a scale that is at its limit: half of the time 0, otherwise
  // chi-squared with one degree of freedom, above 2.71 in one of twenty.
  int above = 0, none = 0;
  for (unsigned long seed = 1; seed <= 200; ++seed) {
    LSM::Random random(seed);
    EventTable table;
    for (int n = 0; n < 500; ++n) {
      LSM::EventSummary shock;
      shock.size = 1e-4 * std::pow(random.uniform(), -0.25);
      table.events.push_back(shock);
    }
    const double gain = roll_off(table, 1e-4).gain;
    ASSERT_GE(gain, 0.0) << "seed " << seed;
    above += gain > 2.706;
    none += gain < 0.01;
  }
  EXPECT_NEAR(above, 10, 10);  // three standard deviations
  EXPECT_NEAR(none, 108, 22);
}

}  // namespace
