// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershocks.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "coverage.h"
#include "event_tables.h"

using LSM::EventSummary;
using namespace LSM::postproc;

namespace {

using Rng = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

Rng generator(unsigned long seed) {
  Rng rng(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(rng.get(), seed);
  return rng;
}

struct Law {
  double K, c, p, background;
};

/// Events after main shocks that follow the law, drawn by inversion.
Sequences omori_sequences(const Law &law, int main_shocks, double first, double window,
                          unsigned long seed) {
  const Rng rng = generator(seed);
  const double q = 1.0 - law.p, low = std::pow(first + law.c, q),
               high = std::pow(window + law.c, q);
  Sequences s;
  s.main_shocks = main_shocks;
  s.first = first;
  s.window = window;
  const unsigned decaying = gsl_ran_poisson(rng.get(), main_shocks * law.K * (high - low) / q);
  const unsigned constant =
      gsl_ran_poisson(rng.get(), main_shocks * law.background * (window - first));
  for (unsigned i = 0; i < decaying; ++i)
    s.times.push_back(
        std::pow(gsl_ran_flat(rng.get(), std::min(low, high), std::max(low, high)), 1.0 / q) -
        law.c);
  for (unsigned i = 0; i < constant; ++i) s.times.push_back(gsl_ran_flat(rng.get(), first, window));
  for (double &t : s.times) t = std::clamp(t, first, window);
  std::sort(s.times.begin(), s.times.end());
  return s;
}

EventTable events(const std::vector<double> &starts, const std::vector<double> &durations,
                  const std::vector<double> &sizes) {
  EventTable table;
  table.info.model = "lsm";
  std::vector<double> ends = starts;
  for (std::size_t i = 0; i < starts.size(); ++i) ends[i] += durations[i];
  table.events = events_of(starts, sizes, ends);
  return table;
}

/// Main shocks, each with aftershocks by Omori's law and half as many foreshocks by the same law
/// back in time, and a steady background throughout.
/// \param each aftershocks of a main shock
EventTable sequences_on_background(int main_shocks, double each, double p, double background,
                                   unsigned long seed) {
  const Rng rng = generator(seed);
  constexpr double apart = 1000.0, window = 100.0, c = 1.0;
  struct At {
    double start, size;
  };
  std::vector<At> all;
  const double q = 1.0 - p, low = std::pow(c, q), high = std::pow(window + c, q);
  const auto delay = [&] {
    return std::pow(gsl_ran_flat(rng.get(), std::min(low, high), std::max(low, high)), 1.0 / q) - c;
  };
  for (int k = 0; k < main_shocks; ++k) {
    const double at = apart * (k + 0.5);
    all.push_back({at, 100.0});
    for (unsigned i = gsl_ran_poisson(rng.get(), each); i > 0; --i)
      all.push_back({at + delay(), 1.0});
    for (unsigned i = gsl_ran_poisson(rng.get(), 0.5 * each); i > 0; --i)
      all.push_back({at - delay(), 1.0});
  }
  const double end = apart * main_shocks;
  for (unsigned i = gsl_ran_poisson(rng.get(), background * end); i > 0; --i)
    all.push_back({gsl_ran_flat(rng.get(), 0.0, end), 1.0});
  std::sort(all.begin(), all.end(), [](const At &a, const At &b) { return a.start < b.start; });
  std::vector<double> starts, sizes;
  for (const At &one : all) {
    starts.push_back(one.start);
    sizes.push_back(one.size);
  }
  return events(starts, std::vector<double>(starts.size(), 0.0), sizes);
}

/// A Poisson catalogue with sizes of a power law.
EventTable poisson(int n, double mean, unsigned long seed) {
  const Rng rng = generator(seed);
  std::vector<double> starts, durations, sizes;
  double time = 0.0;
  for (int i = 0; i < n; ++i) {
    time += gsl_ran_exponential(rng.get(), mean);
    starts.push_back(time);
    durations.push_back(0.0);
    sizes.push_back(gsl_ran_pareto(rng.get(), 0.7, 1.0));
  }
  return events(starts, durations, sizes);
}

// p and the ratio of after- to foreshocks are those of the sequences, not of the background, which
// has three times as many events in the windows.
TEST(Aftershocks, BackgroundIsTakenOff) {
  const SequenceRule rule{50.0, 0.5, 100.0, 0.0};
  std::vector<Measured> p, ratios;
  double raw = 0.0;
  int within = 0;
  constexpr int catalogues = 30;
  for (unsigned long seed = 1; seed <= catalogues; ++seed) {
    const EventTable table = sequences_on_background(200, 12.0, 1.2, 0.3, seed);
    const Sequences s = stack_sequences(table.events, rule);
    EXPECT_EQ(s.main_shocks, 200);
    EXPECT_NEAR(s.quiet_time, 200 * 800.0, 2500.0);
    const Measured background = s.background();
    EXPECT_NEAR(background.value, 0.3, 5.0 * background.error);
    EXPECT_NEAR(s.excess_after().value, 2400.0, 5.0 * s.excess_after().error);
    const Measured ratio = s.after_to_before();
    within += std::fabs(ratio.value - 2.0) < ratio.error;
    raw += static_cast<double>(s.times.size()) / static_cast<double>(s.before.size()) / catalogues;
    ratios.push_back(ratio);
    const OmoriFit fit = fit_omori(s, 1.0);
    p.push_back({fit.p, fit.se_p});
  }
  EXPECT_LT(raw, 1.3);
  const Measured mean_p = mean_of_catalogues(p), mean_ratio = mean_of_catalogues(ratios);
  EXPECT_NEAR(mean_ratio.value, 2.0, 4.0 * mean_ratio.error);
  EXPECT_LT(mean_ratio.error, 0.1);
  EXPECT_GE(within, 14);  // 68 % of 30, less three standard errors
  EXPECT_NEAR(mean_p.value, 1.2, 4.0 * mean_p.error);
  EXPECT_LT(mean_p.error, 0.03);
  // One catalogue has its own error, none has none.
  EXPECT_EQ(mean_of_catalogues({{1.5, 0.2}, {}}).error, 0.2);
  EXPECT_TRUE(std::isnan(mean_of_catalogues({{}, {}}).value));
}

TEST(Sequences, MainShocksByHand) {
  //                        0    1    2    3    4     5    6    7    8    9    10
  const EventTable table =
      events({0, 100, 105, 111, 120, 200, 203, 204, 300, 310, 500},
             {0, 10, 1, 1, 0, 2, 0, 0, 0, 0, 0}, {1, 50, 1, 2, 0.1, 50, 50, 1, 60, 1, 1});
  SequenceRule rule;
  rule.main_size = 50;
  rule.least_size = 1;
  rule.window = 20;
  const Sequences s = stack_sequences(table.events, rule);
  // At 100 (ends at 110), at 200 (ends at 202; the equal one at 203 comes second), at 300.
  EXPECT_EQ(s.main_shocks, 3);
  // 105 begins before the end; 120 is too small.
  EXPECT_EQ(s.times, (std::vector<double>{1, 1, 2, 10}));
  // Nothing ends within 20 before 100 and 300, nor before 200.
  EXPECT_TRUE(s.before.empty());
  rule.first = 1.5;
  EXPECT_EQ(stack_sequences(table.events, rule).times, (std::vector<double>{2, 10}));
  rule.first = 0.0;
  rule.window = 99;
  // 200 ends 98 before 300, which is larger; 100 ends 90 before 200, which is as large and later.
  EXPECT_EQ(stack_sequences(table.events, rule).main_shocks, 2);
  // The window has to lie within the catalogue.
  rule.window = 201;
  EXPECT_EQ(stack_sequences(table.events, rule).main_shocks, 0);
  rule.window = 0.0;
  EXPECT_THROW(stack_sequences(table.events, rule), std::invalid_argument);
  rule.window = rule.first = 1.0;
  EXPECT_THROW(stack_sequences(table.events, rule), std::invalid_argument);
}

TEST(Sequences, BeforeMainShocksByHand) {
  // The main shock is at 100; 99 still goes on then, 97 is too small, 79 is too early.
  const EventTable table =
      events({0, 79, 90, 95, 97, 98, 99, 100, 104, 200}, {0, 0, 2, 1, 0, 0, 5, 1, 0, 0},
             {1, 1, 1, 1, 0.1, 1, 1, 50, 1, 1});
  SequenceRule rule;
  rule.main_size = 50;
  rule.least_size = 1;
  rule.window = 20;
  EXPECT_EQ(stack_sequences(table.events, rule).before, (std::vector<double>{2, 4, 8}));
  rule.first = 5;
  EXPECT_EQ(stack_sequences(table.events, rule).before, (std::vector<double>{8}));
  rule.first = 1;
  const Aftershocks found = aftershocks_of(table, rule, 0.0, 3.0, 0, 1);
  ASSERT_EQ(found.bins.size(), 2u);  // 1 to 3, 3 to 9
  EXPECT_EQ(found.bins[0].before, 1);
  EXPECT_EQ(found.bins[0].count, 0);
  EXPECT_EQ(found.bins[1].before, 2);
  EXPECT_EQ(found.bins[1].count, 1);
}

TEST(Omori, MaximumOfAnIndependentLikelihood) {
  // ln L written down again; no point near the fit is better, and it is flat there.
  const Sequences s = omori_sequences({2.0, 0.5, 1.3, 0.02}, 100, 0.0, 50.0, 3);
  const OmoriFit fit = fit_omori(s);
  ASSERT_FALSE(fit.degenerate) << fit.why;
  const auto log_likelihood = [&s](double K, double c, double p, double background) {
    double sum = 0.0;
    for (const double t : s.times) sum += std::log(K / std::pow(t + c, p) + background);
    const double q = 1.0 - p;
    return sum - static_cast<double>(s.main_shocks) *
                     (K * (std::pow(s.window + c, q) - std::pow(c, q)) / q + background * s.window);
  };
  const double best = log_likelihood(fit.K, fit.c, fit.p, fit.background);
  for (const double up : {-1e-3, 1e-3}) {
    EXPECT_LT(log_likelihood(fit.K * (1 + up), fit.c, fit.p, fit.background), best);
    EXPECT_LT(log_likelihood(fit.K, fit.c * (1 + up), fit.p, fit.background), best);
    EXPECT_LT(log_likelihood(fit.K, fit.c, fit.p + up, fit.background), best);
    EXPECT_LT(log_likelihood(fit.K, fit.c, fit.p, fit.background * (1 + up)), best);
  }
  const double n = static_cast<double>(s.times.size());
  const double constant = n * std::log(n / (100.0 * 50.0)) - n;
  EXPECT_NEAR(fit.likelihood_ratio, 2.0 * (best - constant), 1e-4);
  EXPECT_NEAR(fit.constant, n / 5000.0, 1e-12);
  EXPECT_NEAR(fit.rate(1.0), fit.K * std::pow(1.0 + fit.c, -fit.p) + fit.background, 1e-12);
}

TEST(Omori, ErrorsCoverTheTruth) {
  struct Case {
    Law law;
    double first, hold_c;
  };
  const double fitted = std::nan("");
  for (const Case &one :
       {Case{{1.5, 0.3, 1.1, 0.01}, 0.0, fitted}, Case{{1.0, 0.3, 0.9, 0.02}, 0.05, fitted},
        Case{{1.0, 0.0, 1.2, 0.02}, 0.1, 0.0}}) {
    Coverage p(one.law.p), ln_c(std::log(one.law.c)), ln_K(std::log(one.law.K)),
        background(one.law.background);
    for (unsigned long seed = 1; seed <= 100; ++seed) {
      const OmoriFit fit =
          fit_omori(omori_sequences(one.law, 150, one.first, 100.0, seed), one.hold_c);
      ASSERT_FALSE(fit.degenerate) << fit.why;
      p.add(fit.p, fit.se_p);
      ln_K.add(std::log(fit.K), fit.se_K / fit.K);
      background.add(fit.background, fit.se_background);
      if (std::isnan(one.hold_c))
        ln_c.add(std::log(fit.c), fit.se_c / fit.c);
      else
        EXPECT_EQ(fit.se_c, 0.0);
    }
    p.expect("p");
    ln_K.expect("ln K");
    background.expect("background");
    if (std::isnan(one.hold_c)) ln_c.expect("ln c");
  }
}

// Twice the same sequences, then so many times that they are taken together where they lie close.
TEST(Omori, ManyTimesAreTakenTogether) {
  const Sequences once = omori_sequences({2.0, 0.5, 1.2, 0.02}, 800, 0.0, 100.0, 3);
  ASSERT_GT(once.times.size(), 4200U);
  ASSERT_LT(once.times.size(), 8192U);
  Sequences twice = once;
  twice.main_shocks *= 2;
  twice.times.insert(twice.times.end(), once.times.begin(), once.times.end());
  std::sort(twice.times.begin(), twice.times.end());
  const OmoriFit a = fit_omori(once), b = fit_omori(twice);
  ASSERT_FALSE(a.degenerate) << a.why;
  ASSERT_FALSE(b.degenerate) << b.why;
  EXPECT_NEAR(b.p, a.p, 1e-3 * a.se_p);
  EXPECT_NEAR(b.c, a.c, 1e-3 * a.se_c);
  EXPECT_NEAR(b.K, a.K, 1e-3 * a.se_K);
  EXPECT_NEAR(b.likelihood_ratio / a.likelihood_ratio, 2.0, 1e-4);
  EXPECT_NEAR(b.se_p * std::sqrt(2.0) / a.se_p, 1.0, 1e-3);
}

TEST(Omori, WithoutBackgroundItIsZero) {
  const OmoriFit fit = fit_omori(omori_sequences({5.0, 1.0, 1.5, 0.0}, 300, 0.0, 20.0, 12));
  ASSERT_FALSE(fit.degenerate) << fit.why;
  EXPECT_NEAR(fit.p, 1.5, 4.0 * fit.se_p);
  EXPECT_TRUE(fit.background == 0.0 ? std::isnan(fit.se_background)
                                    : fit.background < 2.0 * fit.se_background);
}

TEST(Omori, AConstantRateIsNoDecay) {
  int decays = 0;
  const int trials = 100;
  for (int seed = 1; seed <= trials; ++seed) {
    const OmoriFit fit = fit_omori(
        omori_sequences({1e-12, 1.0, 1.1, 0.1}, 50, 0.0, 100.0, static_cast<unsigned long>(seed)));
    if (fit.likelihood_ratio > 7.81) ++decays;
    if (fit.likelihood_ratio <= 7.81) {
      EXPECT_TRUE(fit.degenerate);
      EXPECT_EQ(fit.why, "no decay: a constant rate fits as well");
      EXPECT_TRUE(std::isnan(fit.p) && std::isnan(fit.c) && std::isnan(fit.K));
      EXPECT_NEAR(fit.constant, 0.1, 5.0 * fit.se_constant);
      EXPECT_EQ(fit.rate(3.0), fit.constant);
    }
  }
  EXPECT_LE(decays, 10);  // 5 on average, if the approximation holds
}

TEST(Omori, DegenerateAndImpossible) {
  const Sequences s = omori_sequences({0.1, 1.0, 1.1, 0.0}, 30, 0.0, 10.0, 1);
  ASSERT_LT(s.times.size(), 20u);
  EXPECT_TRUE(fit_omori(s).degenerate);
  EXPECT_NE(fit_omori(s).why.find("at least 20 events needed"), std::string::npos);
  // A c far below the first of the times is not told from 0.
  const OmoriFit sharp = fit_omori(omori_sequences({1.0, 1e-9, 0.8, 0.0}, 200, 0.5, 100.0, 2));
  EXPECT_TRUE(sharp.degenerate || sharp.c < 2.0 * sharp.se_c);
  EXPECT_FALSE(
      fit_omori(omori_sequences({1.0, 1e-9, 0.8, 0.0}, 200, 0.5, 100.0, 2), 0.0).degenerate);
  EXPECT_THROW(fit_omori(omori_sequences({1.0, 1.0, 1.1, 0.0}, 30, 0.0, 10.0, 1), 0.0),
               std::invalid_argument);
  EXPECT_THROW(fit_omori(omori_sequences({1.0, 1.0, 1.1, 0.0}, 30, 0.0, 10.0, 1), -1.0),
               std::invalid_argument);
}

TEST(PoissonCatalogue, KeepsTheEventsAndForgetsTheirTimes) {
  const std::vector<EventSummary> shocks =
      events({1, 2, 5, 9, 20}, {0.5, 1, 2, 0, 3}, {1, 2, 3, 4, 5}).events;
  const std::vector<EventSummary> other = poisson_catalogue(shocks, false, 4);
  ASSERT_EQ(other.size(), 5u);
  std::vector<bool> seen(5);
  bool moved = false;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto which = static_cast<std::size_t>(other[i].size) - 1;
    EXPECT_FALSE(seen.at(which));
    seen[which] = true;
    EXPECT_NEAR(other[i].t_end - other[i].t_start, shocks[which].t_end - shocks[which].t_start,
                1e-12);
    if (i > 0) {
      EXPECT_GE(other[i].t_start, other[i - 1].t_end);
    }
    moved = moved || other[i].t_start != shocks[i].t_start;
  }
  EXPECT_TRUE(moved);
  const std::vector<EventSummary> overlapping = poisson_catalogue(shocks, true, 4);
  EXPECT_GE(overlapping.front().t_start, 1.0);
  EXPECT_LE(overlapping.back().t_start, 20.0);
  EXPECT_TRUE(std::is_sorted(
      overlapping.begin(), overlapping.end(),
      [](const EventSummary &a, const EventSummary &b) { return a.t_start < b.t_start; }));
}

TEST(Aftershocks, ShareOfPoissonCatalogues) {
  SequenceRule rule;
  rule.main_size = 30.0;
  rule.least_size = 1.0;
  rule.window = 40.0;
  // The same for a Poisson catalogue as for its own random order: p is uniform.
  int low = 0;
  const int trials = 40;
  for (int seed = 1; seed <= trials; ++seed) {
    const Aftershocks a = aftershocks_of(poisson(1000, 1.0, static_cast<unsigned long>(seed)), rule,
                                         std::nan(""), 1.6, 9, 100);
    ASSERT_FALSE(std::isnan(a.p));
    if (a.p <= 0.5) ++low;
  }
  expect_binomial(low, trials, 0.5, "p of at most 0.5");
}

TEST(Aftershocks, SequencesStandOutFromPoissonCatalogues) {
  // A main shock every 100 time units, and 60 events after it with p = 2, c = 1.
  EventTable clustered = poisson(3000, 1.0, 77);
  const Rng rng = generator(5);
  std::vector<std::pair<double, double>> rows;
  for (const EventSummary &event : clustered.events)
    rows.emplace_back(event.t_start, std::min(event.size, 100.0));
  for (int main = 0; main < 29; ++main) {
    const double time = 50.0 + 100.0 * main;
    rows.emplace_back(time, 1e4);
    for (int k = 0; k < 60; ++k)
      rows.emplace_back(time + 1.0 / gsl_ran_flat(rng.get(), 0.0, 1.0) - 1.0, 1.0);
  }
  std::sort(rows.begin(), rows.end());
  SequenceRule rule;
  rule.main_size = 1e4;
  rule.least_size = 1.0;
  rule.window = 40.0;
  std::vector<double> starts, sizes;
  for (const auto &[time, size] : rows) {
    starts.push_back(time);
    sizes.push_back(size);
  }
  clustered.events = events_of(starts, sizes);
  const Aftershocks a = aftershocks_of(clustered, rule, std::nan(""), 1.6, 19, 1);
  EXPECT_EQ(a.sequences.main_shocks, 29);
  ASSERT_FALSE(a.fit.degenerate) << a.fit.why;
  EXPECT_NEAR(a.fit.p, 2.0, 4.0 * a.fit.se_p);
  EXPECT_NEAR(a.fit.c, 1.0, 4.0 * a.fit.se_c);
  EXPECT_LT(a.fit.se_p, 0.3);
  EXPECT_EQ(a.p, 0.05);
  ASSERT_GT(a.bins.size(), 5u);
  // A bin of few events scatters too much to tell anything.
  const auto full = std::find_if(a.bins.begin(), a.bins.end(),
                                 [](const RateBin &bin) { return bin.count >= 20; });
  ASSERT_NE(full, a.bins.end());
  const RateBin &early = *full, &late = a.bins.back();
  EXPECT_GT(early.rate, early.poisson + 5.0 * early.scatter);
  EXPECT_NEAR(late.rate, a.fit.rate(late.centre), 4.0 * late.error + 0.1 * late.rate);
}

}  // namespace
