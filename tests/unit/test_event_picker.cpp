// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "events/event_filter.h"
#include "events/event_picker.h"
#include "numerics/random.h"
#include "same_events.h"
#include "unit_files.h"

namespace {

using LSM::Event;
using LSM::EventFilter;
using LSM::EventPicker;
using LSM::PickerReading;
using LSM::PickerSettings;
using unit::expect_same_events;

PickerSettings settings(PickerReading reading, double lambda) {
  PickerSettings out;
  out.reading = reading;
  out.lambda = lambda;
  return out;
}

/// Returns the events of the series PE(0), PE(1), ... at times 0, dt, ...
std::vector<Event> pick(EventPicker &picker, const std::vector<double> &pe, double dt = 1.0,
                        std::int64_t first = 0) {
  std::vector<Event> events;
  Event event;
  for (std::size_t i = 0; i < pe.size(); ++i) {
    const std::int64_t step = first + static_cast<std::int64_t>(i);
    if (picker.push(step, static_cast<double>(step) * dt, pe[i], event)) events.push_back(event);
  }
  return events;
}

/// A sawtooth of loading and drops of random lengths, with noise; sizes span several decades.
std::vector<double> stick_slip(std::uint64_t seed, int count) {
  LSM::Random random(seed);
  std::vector<double> pe;
  double value = 100.0;
  bool dropping = false;
  int left = 50;
  for (int i = 0; i < count; ++i) {
    pe.push_back(value);
    if (left-- == 0) {
      dropping = !dropping;
      left = static_cast<int>(dropping ? random.uniform(1, 20) : random.uniform(20, 200));
    }
    value += (dropping ? -random.uniform(0.1, 3.0) : 0.1) + random.uniform(-0.05, 0.05);
  }
  return pe;
}

// ---- hand-computed series: PE = 0 2 1 0 0.25 1.25 2.25, x = 2 -1 -1 0.25 1 1, lambda = 1/2 ----

const std::vector<double> by_hand = {0, 2, 1, 0, 0.25, 1.25, 2.25};

TEST(EventPicker, EachReadingByHand) {
  const struct {
    PickerReading reading;
    double lambda;
    std::vector<double> rate;  // A after each sample
    std::int64_t start, end;   // samples
    double size;
  } cases[] = {
      // A: 1, 0 (not negative: no event yet), -1/2, -1/8, 7/16
      {PickerReading::exponential, 0.5, {0, 1, 0, -0.5, -0.125, 0.4375, 0.71875}, 2, 4, 0.75},
      // A <- (x + A/2) / (3/2) = (2x + A)/3
      {PickerReading::average,
       0.5,
       {0, 4.0 / 3, -2.0 / 9, -20.0 / 27, -13.0 / 162, 311.0 / 486, 1283.0 / 1458},
       1,
       4,
       1.75},
      // Denominators 1, 3/2, 2, 5/2, 3, 7/2. A: 2, 0, -1/2, 0 (the event stays open), 1/3, 1/3
      {PickerReading::literal, 0.5, {0, 2, 0, -0.5, 0, 1.0 / 3, 1.0 / 3}, 2, 4, 0.75},
      // without memory the raw sign decides
      {PickerReading::exponential, 0.0, {0, 2, -1, -1, 0.25, 1, 1}, 1, 3, 2.0}};
  for (const auto &expected : cases) {
    EventPicker picker(settings(expected.reading, expected.lambda));
    Event event;
    for (std::size_t i = 0; i < by_hand.size(); ++i) {
      SCOPED_TRACE(std::string(to_string(expected.reading)) + " " + std::to_string(i));
      // Steps and times differ from the indices, so that confusing them is noticed.
      const auto at = static_cast<std::int64_t>(i);
      const bool reported =
          picker.push(1000 + at, 50.0 + 0.25 * static_cast<double>(i), by_hand[i], event);
      EXPECT_DOUBLE_EQ(picker.rate(), expected.rate[i]);
      EXPECT_EQ(picker.in_event(), at > expected.start && at <= expected.end);
      EXPECT_EQ(reported, at == expected.end + 1);
    }
    EXPECT_EQ(event.step_start, 1000 + expected.start);
    EXPECT_EQ(event.step_end, 1000 + expected.end);
    EXPECT_EQ(event.t_start, 50.0 + 0.25 * static_cast<double>(expected.start));
    EXPECT_EQ(event.t_end, 50.0 + 0.25 * static_cast<double>(expected.end));
    EXPECT_EQ(event.pe_start, by_hand[static_cast<std::size_t>(expected.start)]);
    EXPECT_EQ(event.pe_end, by_hand[static_cast<std::size_t>(expected.end)]);
    EXPECT_EQ(event.size, expected.size);
  }
}

TEST(EventPicker, SeriesThatStartsWithADrop) {
  EventPicker picker(settings(PickerReading::exponential, 0.5));
  const std::vector<Event> events = pick(picker, {5, 3, 2, 4});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step_start, 0);
  EXPECT_EQ(events[0].step_end, 2);
  EXPECT_EQ(events[0].size, 3.0);
}

TEST(EventPicker, OpenEventAtTheEndIsNotReported) {
  EventPicker picker(settings(PickerReading::exponential, 0.5));
  EXPECT_TRUE(pick(picker, {0, 1, -5, -6}).empty());
  EXPECT_TRUE(picker.in_event());
}

// ---- readings ----

TEST(EventPicker, LiteralFollowsTheRawSignOnceItsMemoryIsGone) {
  // Changes of magnitude 0.5 to 1.5: from the tenth change on the remembered part, at most
  // 1.5 / (t - 1), cannot outweigh the change itself. The first ten are loading.
  LSM::Random random(42);
  std::vector<double> pe = {0.0};
  for (int i = 0; i < 20000; ++i) {
    const double sign = i < 10 || random.uniform() < 0.7 ? 1.0 : -1.0;
    pe.push_back(pe.back() + sign * random.uniform(0.5, 1.5));
  }
  EventPicker literal(settings(PickerReading::literal, 0.99));
  EventPicker raw(settings(PickerReading::exponential, 0.0));
  EventPicker smooth(settings(PickerReading::exponential, 0.99));
  const std::vector<Event> expected = pick(raw, pe);
  EXPECT_GT(expected.size(), 2000U);
  expect_same_events(pick(literal, pe), expected);
  EXPECT_LT(pick(smooth, pe).size(), expected.size() / 10);
}

TEST(EventPicker, SizesArePositiveForAllReadings) {
  // The changes of an open event sum to a weighted sum of its negative A, so this holds exactly.
  for (PickerReading reading :
       {PickerReading::exponential, PickerReading::average, PickerReading::literal}) {
    for (double lambda : {0.0, 0.5, 0.9, 0.99}) {
      SCOPED_TRACE(std::string(to_string(reading)) + " " + std::to_string(lambda));
      EventPicker picker(settings(reading, lambda));
      const std::vector<double> pe = stick_slip(17, 20000);
      const std::vector<Event> events = pick(picker, pe);
      EXPECT_GT(events.size(), 20U);
      for (std::size_t i = 0; i < events.size(); ++i) {
        const Event &event = events[i];
        ASSERT_GT(event.size, 0.0);
        ASSERT_LT(event.step_start, event.step_end);
        ASSERT_EQ(event.pe_start, pe[static_cast<std::size_t>(event.step_start)]);
        ASSERT_EQ(event.pe_end, pe[static_cast<std::size_t>(event.step_end)]);
        ASSERT_EQ(event.size, event.pe_start - event.pe_end);
        ASSERT_GT(event.step_start, i ? events[i - 1].step_end : -1);
      }
    }
  }
}

// ---- memory time ----

// PE rises by 1 per time until 50, falls by 3 per time until 60, rises again.
double ramps(double t) {
  if (t <= 50.0) return t;
  if (t <= 60.0) return 50.0 - 3.0 * (t - 50.0);
  return 20.0 + (t - 60.0);
}

std::vector<double> sampled_ramps(double dt) {
  std::vector<double> pe;
  const int count = static_cast<int>(std::lround(80.0 / dt));
  for (int i = 0; i <= count; ++i) pe.push_back(ramps(i * dt));
  return pe;
}

TEST(EventPicker, MemoryTimeMakesPicksIndependentOfTheTimeStep) {
  // Between kinks A/dt relaxes as exp(-t/T) to the slope of PE, for any dt.
  const double memory = 2.0;
  const double before = 1.0 - std::exp(-50.0 / memory);
  const double start = 50.0 + memory * std::log((before + 3.0) / 3.0);
  const double low = -3.0 + (before + 3.0) * std::exp(-10.0 / memory);
  const double end = 60.0 + memory * std::log(1.0 - low);
  for (double dt : {0.1, 0.03125, 0.01, 0.001}) {
    SCOPED_TRACE(dt);
    EventPicker picker(
        settings(PickerReading::exponential, LSM::lambda_from_memory_time(memory, dt)));
    const std::vector<Event> events = pick(picker, sampled_ramps(dt), dt);
    ASSERT_EQ(events.size(), 1U);
    // The event starts with the sample before the one at which A has changed its sign.
    EXPECT_GE(events[0].t_start, start - dt * 1.001);
    EXPECT_LE(events[0].t_start, start + dt * 0.001);
    EXPECT_GE(events[0].t_end, end - dt * 1.001);
    EXPECT_LE(events[0].t_end, end + dt * 0.001);
    EXPECT_NEAR(events[0].size, ramps(start) - ramps(end), 3.0 * dt + dt);
  }
}

/// While PE rises at a constant rate the smoothed change is that of a step, so that a sudden drop
/// is seen only if 1 - lambda of it outweighs what is loaded in a step.
TEST(EventPicker, SuddenDropMustExceedTheLoadingOfOneMemory) {
  const double loading = 0.25, lambda = 0.99;
  const double least = loading / (1.0 - lambda);  // 100 steps of loading
  for (const double drop : {0.99 * least, 1.01 * least}) {
    SCOPED_TRACE(drop / least);
    std::vector<double> pe = {0.0};
    for (int step = 1; step <= 4000; ++step)
      pe.push_back(pe.back() + loading - (step == 2000 ? drop : 0.0));
    EventPicker picker(settings(PickerReading::exponential, lambda));
    const std::vector<Event> events = pick(picker, pe);
    ASSERT_EQ(events.size(), drop > least ? 1U : 0U);
    if (!events.empty()) {
      EXPECT_NEAR(events[0].size, drop - loading, 1e-9 * drop);
    }
  }
}

TEST(EventPicker, LambdaFromMemoryTime) {
  EXPECT_DOUBLE_EQ(LSM::lambda_from_memory_time(2.0, 0.5), std::exp(-0.25));
  // Memory decays as much in ten small steps as in one that is ten times as long.
  EXPECT_NEAR(std::pow(LSM::lambda_from_memory_time(3.0, 0.01), 10),
              LSM::lambda_from_memory_time(3.0, 0.1), 1e-14);
  // 0.99 per step is a memory of very nearly 100 steps.
  EXPECT_NEAR(LSM::lambda_from_memory_time(100.0, 1.0), 0.99, 1e-4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(LSM::lambda_from_memory_time(bad, 1.0), std::invalid_argument);
    EXPECT_THROW(LSM::lambda_from_memory_time(1.0, bad), std::invalid_argument);
  }
}

// ---- restart, stride, push_change ----

TEST(EventPicker, GoesOnFromAStateSavedAnywhere) {
  const std::vector<double> pe = stick_slip(9, 3000);
  for (PickerReading reading :
       {PickerReading::exponential, PickerReading::average, PickerReading::literal}) {
    SCOPED_TRACE(to_string(reading));
    const PickerSettings chosen = settings(reading, 0.9);
    EventPicker whole(chosen);
    const std::vector<Event> expected = pick(whole, pe);
    ASSERT_GT(expected.size(), 5U);
    int in_mid_event = 0;
    for (std::size_t cut = 0; cut <= pe.size(); cut += 7) {
      const auto middle = pe.begin() + static_cast<std::ptrdiff_t>(cut);
      EventPicker before(chosen), after(chosen);
      std::vector<Event> events = pick(before, {pe.begin(), middle});
      in_mid_event += before.in_event();
      char bytes[sizeof(LSM::PickerState)];
      std::memcpy(bytes, &before.state(), sizeof(bytes));
      LSM::PickerState state;
      std::memcpy(&state, bytes, sizeof(bytes));
      after.set_state(state);
      EXPECT_EQ(after.in_event(), before.in_event());
      const std::vector<Event> rest =
          pick(after, {middle, pe.end()}, 1.0, static_cast<std::int64_t>(cut));
      events.insert(events.end(), rest.begin(), rest.end());
      SCOPED_TRACE(cut);
      expect_same_events(events, expected);
      EXPECT_EQ(std::memcmp(&after.state(), &whole.state(), sizeof(bytes)), 0);
      if (HasFailure()) return;
    }
    EXPECT_GT(in_mid_event, 5);
  }
}

TEST(EventPicker, RefusesImpossibleStates) {
  EventPicker picker{PickerSettings()};
  LSM::PickerState state;
  state.samples = -1;
  EXPECT_THROW(picker.set_state(state), std::invalid_argument);
  state = LSM::PickerState();
  state.rate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(picker.set_state(state), std::invalid_argument);
  state = LSM::PickerState();
  state.in_event = 2;
  EXPECT_THROW(picker.set_state(state), std::invalid_argument);
  state = LSM::PickerState();
  state.in_event = 1;
  state.step = 5;
  state.rate = 1.0;  // an open event has A <= 0
  EXPECT_THROW(picker.set_state(state), std::invalid_argument);
  EXPECT_EQ(picker.state().samples, 0);
}

TEST(EventPicker, GivenChangesPickTheSame) {
  const std::vector<double> pe = stick_slip(3, 20000);
  EventPicker by_difference(settings(PickerReading::exponential, 0.9));
  EventPicker by_change(settings(PickerReading::exponential, 0.9));
  const std::vector<Event> expected = pick(by_difference, pe);
  ASSERT_GT(expected.size(), 20U);
  std::vector<Event> events;
  Event event;
  for (std::size_t i = 0; i < pe.size(); ++i) {
    // The change that comes with the first sample must not count.
    const double change = i ? pe[i] - pe[i - 1] : -1e9;
    const auto step = static_cast<std::int64_t>(i);
    if (by_change.push_change(step, static_cast<double>(step), pe[i], change, event))
      events.push_back(event);
  }
  expect_same_events(events, expected);
}

TEST(EventPicker, GivenChangesSeeWhatDifferencesOfLargeEnergiesLose) {
  // Changes of 1e-6 are below the spacing of doubles at 1e12, about 1.2e-4.
  EventPicker by_difference(settings(PickerReading::exponential, 0.5));
  EventPicker by_change(settings(PickerReading::exponential, 0.5));
  Event event;
  double pe = 1e12;
  int nonpositive = 0;
  for (int i = 0; i < 100; ++i) {
    const double change = i % 20 < 10 ? 1e-6 : -1e-6;
    pe += change;
    by_difference.push(i, i, pe, event);
    if (by_change.push_change(i, i, pe, change, event)) nonpositive += event.size <= 0.0 ? 1 : 0;
  }
  EXPECT_EQ(by_difference.rate(), 0.0);
  EXPECT_FALSE(by_difference.in_event());
  EXPECT_TRUE(by_change.in_event());
  EXPECT_EQ(nonpositive, 4);  // the sizes still come from the rounded energy
}

// ---- events that are not written ----

TEST(EventPicker, ReportsEventsOfEverySize) {
  EventPicker picker(settings(PickerReading::exponential, 0.5));
  Event event;
  event.id = 77;
  // The given change is -1, while the energy is constant (first event) or rises (second event).
  EXPECT_FALSE(picker.push_change(0, 0.0, 1.0, 0.0, event));
  EXPECT_FALSE(picker.push_change(1, 1.0, 1.0, -1.0, event));
  EXPECT_EQ(event.id, 77) << "no event has ended";
  EXPECT_TRUE(picker.push_change(2, 2.0, 1.0, 2.0, event));
  EXPECT_EQ(event.size, 0.0);
  EXPECT_FALSE(picker.push_change(3, 3.0, 1.5, -3.0, event));
  EXPECT_TRUE(picker.push_change(4, 4.0, 1.5, 9.0, event));
  EXPECT_EQ(event.size, -0.5);
}

Event of_size(double size, double t_start = 0.0) {
  Event event;
  event.size = size;
  event.t_start = t_start;
  return event;
}

TEST(EventFilter, NonPositiveSizesAreCountedAndKeptOnlyOnDemand) {
  for (bool keep : {false, true}) {
    SCOPED_TRACE(keep);
    EventFilter filter({10.0, keep});
    for (const double size : {0.0, -0.5}) EXPECT_EQ(filter.passes(of_size(size)), keep);
    EXPECT_EQ(filter.counts().dropped_nonpositive, keep ? 0 : 2);
    EXPECT_EQ(filter.counts().dropped_small, 0);
  }
}

TEST(EventFilter, EventsThatAreLeftOutAreCountedAndTakeNoNumber) {
  EventFilter filter({2.0, false, 100.0});
  std::vector<Event> written;
  for (Event event : {of_size(1, 200), of_size(2, 200), of_size(3, 99), of_size(1, 99),
                      of_size(0, 99), of_size(4, 100)}) {
    if (!filter.passes(event)) continue;
    filter.number(event);
    written.push_back(event);
  }
  ASSERT_EQ(written.size(), 2U);
  EXPECT_EQ(written[0].id, 1);
  EXPECT_EQ(written[0].size, 2.0) << "just large enough";
  EXPECT_EQ(written[1].id, 2);
  EXPECT_EQ(written[1].t_start, 100.0) << "just late enough";
  const LSM::FilterCounts &counts = filter.counts();
  EXPECT_EQ(counts.events, 2);
  EXPECT_EQ(counts.dropped_small, 2);
  EXPECT_EQ(counts.dropped_nonpositive, 1);
  EXPECT_EQ(counts.before_warmup, 1);
  EXPECT_EQ(counts.last_size, 4.0);
}

// ---- bad input ----

TEST(EventPicker, RefusesSettingsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double lambda : {-0.01, 1.0, 1.5, nan})
    EXPECT_THROW(EventPicker(settings(PickerReading::exponential, lambda)), std::invalid_argument);
  for (double size : {-1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(EventFilter({size}), std::invalid_argument);
}

TEST(EventPicker, RefusesBadSamplesAndForgetsThem) {
  EventPicker picker(settings(PickerReading::exponential, 0.5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Event event;
  EXPECT_THROW(picker.push(0, 0.0, nan, event), std::invalid_argument);
  picker.push(10, 1.0, 1.0, event);
  picker.push(11, 1.1, 2.0, event);
  const LSM::PickerState before = picker.state();
  unit::expect_error<std::invalid_argument>([&] { picker.push(12, 1.2, nan, event); },
                                            "potential energy at step 12 is not a finite number");
  unit::expect_error<std::invalid_argument>([&] { picker.push(11, 1.2, 3.0, event); },
                                            "step 11 after step 11");
  EXPECT_THROW(picker.push(12, 1.0, 3.0, event), std::invalid_argument);
  EXPECT_THROW(picker.push(12, nan, 3.0, event), std::invalid_argument);
  EXPECT_THROW(picker.push_change(12, 1.2, 3.0, nan, event), std::invalid_argument);
  EXPECT_EQ(std::memcmp(&before, &picker.state(), sizeof(before)), 0);
  EXPECT_NO_THROW(picker.push(12, 1.2, 3.0, event));
}

}  // namespace
