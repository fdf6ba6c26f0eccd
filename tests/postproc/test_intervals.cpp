// SPDX-License-Identifier: GPL-2.0-or-later
// Inter-event times, and the fits to them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "interval_figures.h"
#include "event_tables.h"
#include "intervals.h"
#include "numbers.h"
#include "unit_files.h"

using namespace LSM::postproc;
using unit::contains;

namespace {

EventTable events(const std::vector<double> &starts, const std::vector<double> &sizes) {
  EventTable table;
  table.label = "made up";
  table.info.model = "lsm";
  table.events = events_of(starts, sizes);
  return table;
}

/// Events whose inter-event times are gamma distributed with the given shape and scale.
EventTable gamma_events(double shape, double scale, int n) {
  gsl_rng *generator = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(generator, 20);
  std::vector<double> starts = {0.0};
  for (int i = 0; i < n; ++i)
    starts.push_back(starts.back() + gsl_ran_gamma(generator, shape, scale));
  gsl_rng_free(generator);
  return events(starts, std::vector<double>(starts.size(), 1.0));
}

/// The fit of the first curve with delta = 1.
const IntervalFit *fit_by(const std::vector<IntervalCurve> &curves, const std::string &method) {
  for (const IntervalFit &fit : curves.at(0).fits)
    if (fit.method == method && fit.held == 1.0) return &fit;
  return nullptr;
}

// For 1e7 times, 200 random series would take minutes.
TEST(Intervals, FewerRandomSeriesOfLongOnes) {
  EXPECT_EQ(shuffles_for(0), 200);
  EXPECT_EQ(shuffles_for(100'000), 200);
  EXPECT_EQ(shuffles_for(1'000'000), 20);
  EXPECT_EQ(shuffles_for(100'000'000), 19);
}

// Short times are left out of the fit. The limit is a multiple of the mean, whatever the unit, and
// C is that of the density of all times.
TEST(Intervals, FitFromALowerEndOn) {
  const EventTable table = gamma_events(0.7, 20.0, 20000);  // mean 14
  IntervalSettings settings;
  settings.thresholds = {0.0};
  settings.deltas = {1.0};
  settings.least_squares = false;
  settings.replicas = 0;
  EXPECT_FALSE(settings.shortest);
  for (const double shortest : {0.0, 0.05, 0.3}) {
    settings.shortest = shortest;
    settings.rescale = false;
    const IntervalCurve curve = interval_curves({table}, settings)[0];
    const GeneralisedGammaFit fit = curve.fits[0].fit;
    EXPECT_NEAR(fit.lo, shortest * curve.mean, 1e-12);
    EXPECT_NEAR(fit.gamma, 0.7, 4.0 * fit.se_gamma);
    EXPECT_LT(fit.se_gamma, 0.03);
    EXPECT_NEAR(fit.C, 1.0 / (std::pow(20.0, 0.7) * std::tgamma(0.7)), 4.0 * fit.se_C);
    EXPECT_LT(fit.se_C, 0.1 * fit.C);
    settings.rescale = true;
    const GeneralisedGammaFit again = interval_curves({table}, settings)[0].fits[0].fit;
    EXPECT_NEAR(again.gamma, fit.gamma, 1e-5);
    EXPECT_NEAR(again.B * curve.mean, fit.B, 1e-4 * fit.B);
    EXPECT_EQ(again.n, fit.n);
  }
}

/// Renewal events with gamma-distributed times, as found by a picker with the given memory: after
/// each event it finds none for a random time whose mean is the memory.
EventTable picked_events(double shape, double mean, double memory, std::size_t n,
                         gsl_rng *generator) {
  std::vector<double> starts;
  double t = 0.0, deaf_until = -1.0;
  while (starts.size() < n) {
    t += gsl_ran_gamma(generator, shape, mean / shape);
    if (t < deaf_until) continue;
    starts.push_back(t);
    deaf_until = t + gsl_ran_exponential(generator, memory);
  }
  EventTable table = events(starts, std::vector<double>(starts.size(), 1.0));
  table.info.parameters = {{"dt", "0.1"},
                           {"picker", "exponential"},
                           {"lambda", LSM::text::number(std::exp(-0.1 / memory))}};
  return table;
}

// The value that all commands quote, from times above 2.5 memories of the picker, is gamma of the
// events, and its errors cover it; with all times it is biased by the picker.
TEST(Intervals, GammaWithoutThePicker) {
  gsl_rng *const generator = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_rng_set(generator, 17);
  IntervalSettings usual, all;
  for (IntervalSettings *settings : {&usual, &all}) {
    settings->thresholds = {0.0};
    settings->deltas = {1.0};
    settings->least_squares = false;
    settings->replicas = 0;
  }
  all.shortest = 0.0;
  for (const double mean : {20.0, 70.0})
    for (const double shape : {0.7, 1.0}) {
      constexpr int trials = 100;
      double sum = 0.0, biased = 0.0;
      int one = 0, two = 0;
      for (int trial = 0; trial < trials; ++trial) {
        const EventTable table = picked_events(shape, mean, 2.0, 500, generator);
        EXPECT_NEAR(table.picker_memory(), 2.0, 1e-9);
        const IntervalCurve curve = interval_curves({table}, usual)[0];
        EXPECT_NEAR(curve.shortest, 5.0, 1e-9);
        const GeneralisedGammaFit fit = curve.fits[0].fit;
        ASSERT_FALSE(fit.degenerate) << fit.why;
        sum += fit.gamma;
        one += std::fabs(fit.gamma - shape) < fit.se_gamma;
        two += std::fabs(fit.gamma - shape) < 2.0 * fit.se_gamma;
        biased += interval_curves({table}, all)[0].fits[0].fit.gamma;
      }
      EXPECT_NEAR(sum / trials, shape, 0.09) << mean << ' ' << shape;
      EXPECT_GE(one, 54) << mean << ' ' << shape;  // 68 % less three standard errors
      EXPECT_GE(two, 85) << mean << ' ' << shape;  // 95 %, less the remaining bias
      EXPECT_GT(biased / trials - shape, 0.1) << mean << ' ' << shape;
    }
  gsl_rng_free(generator);
}

TEST(Intervals, ShortestTimeThatSaysSomething) {
  EventTable table = gamma_events(0.7, 20.0, 5000);  // mean 14
  IntervalSettings settings;
  settings.thresholds = {0.0};
  settings.replicas = 0;
  const auto shortest = [&](const LSM::files::Parameters &header) {
    table.info.parameters = header;
    return interval_curves({table}, settings)[0].shortest;
  };
  const double mean = interval_curves({table}, settings)[0].mean;
  const std::string lambda = LSM::text::number(std::exp(-0.1 / 2.0));
  EXPECT_NEAR(shortest({}), 0.05 * mean, 1e-12);
  EXPECT_NEAR(shortest({{"dt", "0.1"}, {"lambda", lambda}}), 5.0, 1e-9);
  EXPECT_NEAR(shortest({{"dt", "0.02"}, {"stride", "5"}, {"lambda", lambda}}), 5.0, 1e-9);
  EXPECT_NEAR(shortest({{"dt", "0.001"}, {"lambda", lambda}}), 0.05 * mean, 1e-12);
  EXPECT_NEAR(shortest({{"dt", "0.1"}, {"lambda", lambda}, {"picker", "literal"}}), 0.05 * mean,
              1e-12);
  EXPECT_NEAR(shortest({{"dt", "4"}, {"lambda", "0.5"}, {"picker", "average"}}),
              2.5 * 4 / std::log(3.0), 1e-9);
  EXPECT_NEAR(shortest({{"dt", "0.1"}, {"lambda", lambda}, {"events", "ruptures"}}), 0.05 * mean,
              1e-12);

  table.info.parameters = {{"dt", "0.1"}, {"lambda", lambda}};
  const IntervalCurve curve = interval_curves({table}, settings)[0];
  EXPECT_EQ(curve.fits[0].method, "maximum likelihood");
  EXPECT_EQ(curve.fits[0].held, 1.0);
  EXPECT_EQ(curve.fits[1].method, "least squares");
  EXPECT_LT(curve.fits[1].fit.lo, 0.5);
}

TEST(Intervals, TimesFromStartToStartAboveTheThreshold) {
  const EventTable table = events({1.0, 2.0, 4.0, 8.0}, {1.0, 0.1, 1.0, 0.5});
  EXPECT_EQ(inter_event_times(table, 0.0), (std::vector<double>{1.0, 2.0, 4.0}));
  EXPECT_EQ(inter_event_times(table, 0.5), (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(inter_event_times(table, 2.0), std::vector<double>());
}

TEST(Intervals, PoorFitsAreRejected) {
  IntervalSettings settings;
  settings.shortest = 0.0;
  settings.deltas = {1.0};
  settings.replicas = 100;
  const auto good = interval_curves({gamma_events(0.7, 20.0, 5000)}, settings);
  // Two clusters of times are no gamma density.
  std::vector<double> starts = {0.0};
  for (int i = 0; i < 2000; ++i)
    starts.push_back(starts.back() +
                     (i % 2 ? 1.0 : 100.0) * (1.0 + 0.5 * ((i * 7919) % 2000) / 2e3));
  const auto poor =
      interval_curves({events(starts, std::vector<double>(starts.size(), 1.0))}, settings);
  const char *const method = "maximum likelihood";
  ASSERT_NE(fit_by(good, method), nullptr);
  ASSERT_NE(fit_by(poor, method), nullptr);
  EXPECT_FALSE(fit_by(good, method)->rejected());
  EXPECT_GT(fit_by(good, method)->p.value, 0.05);
  EXPECT_GT(fit_by(good, method)->p.error, 0.01);
  EXPECT_LT(fit_by(good, method)->fit.ks, 0.1);
  EXPECT_TRUE(fit_by(poor, method)->rejected());
  EXPECT_EQ(fit_by(poor, method)->p.value, 1.0 / 101.0);
  EXPECT_TRUE(contains(interval_fit_table(poor, false).text(), "rejected: p below 0.05"));
  EXPECT_TRUE(contains(interval_fit_table(poor, false).csv(), ",yes,made up,\"maximum likelihood"));
  EXPECT_TRUE(contains(interval_fit_table(good, false).csv(), ",no,made up,\"maximum likelihood"));
  const IntervalFit *const binned = fit_by(good, "least squares");
  ASSERT_NE(binned, nullptr);
  EXPECT_TRUE(std::isnan(binned->fit.ks));
  EXPECT_GT(binned->fit.chi2, 0.0);
  EXPECT_TRUE(std::isfinite(binned->p.value));
  EXPECT_TRUE(std::isnan(binned->p.error));

  // Without replicas there is no statement about the law.
  settings.replicas = 0;
  const auto quick = interval_curves({gamma_events(0.7, 20.0, 5000)}, settings);
  EXPECT_TRUE(std::isnan(fit_by(quick, method)->p.value));
  EXPECT_FALSE(fit_by(quick, method)->rejected());
  EXPECT_TRUE(contains(interval_fit_table(quick, false).csv(), ",,,,made up,\"maximum likelihood"));
}

}  // namespace
