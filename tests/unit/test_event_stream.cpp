// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "read_catalogue.h"
#include "read_series.h"
#include "same_events.h"
#include "unit_files.h"

namespace {

using LSM::EventSettings;
using LSM::EventStream;
using LSM::EventStreamError;
using LSM::FaultGrid;
using LSM::GatheredBlock;
using LSM::SavedStream;

constexpr double length = 20.0;
constexpr double dt = 0.5;

/// An artificial fault that is loaded and slips from time to time: PE of two ranks and the sums of
/// its faces and contacts as functions of the step.
double pe_at(std::int64_t step) {
  const double phase = static_cast<double>(step % 40);
  return 10.0 + 0.01 * static_cast<double>(step % 7) +
         (phase < 30 ? 0.1 * phase : 3.0 - 0.3 * (phase - 30));
}
bool slides(std::int64_t step) { return step % 40 >= 30; }
double friction_at(std::int64_t step) {
  return slides(step) ? 0.25 * static_cast<double>(step % 40) : 0.0625;
}

struct MadeUpRun {
  EventSettings settings;
  LSM::SceneInfo scene{{{"program", "made up"}, {"links", "7"}}, 2, dt};
  LSM::StepClock clock{100.0, 0, dt};
  bool plane;
  FaultGrid grid;
  std::vector<double> sums;  // of the incomplete interval
  std::unique_ptr<EventStream> stream;

  explicit MadeUpRun(const EventSettings &s, bool on_plane = false) : settings(s), plane(on_plane) {
    stream = std::make_unique<EventStream>(settings);
    grid = grid_at(0);
    if (settings.records_slip()) stream->set_grid(grid);
    sums.resize(LSM::fields_of(grid) * static_cast<std::size_t>(grid.cells()));
  }
  FaultGrid grid_at(std::int64_t step) const {
    const FaultGrid strike = settings.grid(0.0, length, step, clock.at(step), dt);
    return plane ? settings.plane(strike, -3.0, 3.0) : strike;
  }

  void begin() {
    stream->begin_files(0, false, scene, clock);
    if (settings.records_slip()) stream->begin_fault(pe_at(0), sums);
  }
  void restart(std::int64_t step, const std::vector<double> &state) {
    SavedStream saved;
    ASSERT_TRUE(saved.read(state, 0));
    grid = grid_at(step);
    if (settings.records_slip()) {
      grid = saved.continued(grid);
      stream->set_grid(grid);
      sums = saved.open_sums;
    }
    stream->set_state(saved);
    stream->begin_files(step, true, scene, clock);
  }

  void add_contacts(std::int64_t step) {
    for (int cell = 0; cell < grid.cells(); ++cell) {
      double *const s = &sums[LSM::fields_of(grid) * static_cast<std::size_t>(cell)];
      const int b = cell / grid.rows;
      const bool slips = slides(step) && b >= 3 && b < 6 + step / 40;
      if (plane) {
        s[LSM::UPPER_DIP] += slips ? -0.01 * (cell + 1) : 0.0;
        s[LSM::LOWER_STEPS] += 1.0;
        s[LSM::FORCE_DIP] -= 0.1;
      }
      s[LSM::UPPER] += slips ? 0.02 * (b + 1) : 1e-5;
      s[LSM::UPPER_STEPS] += 1.0;
      s[LSM::WORK] += slips ? 0.001 * (b + 1) : 0.0;
      s[LSM::FORCE] += 1.0 + 0.01 * static_cast<double>(step % 40) - (slips ? 0.1 : 0.0);
    }
  }

  /// Runs the steps `from` to `to` in blocks of the given length.
  void run(std::int64_t from, std::int64_t to, int steps) {
    for (std::int64_t first = from; first <= to; first += steps) {
      GatheredBlock block;
      block.first = first;
      block.count = static_cast<int>(std::min<std::int64_t>(steps, to - first + 1));
      block.ranks = 2;
      block.pe.resize(2 * static_cast<std::size_t>(block.count));
      for (int n = 0; n < block.count; ++n) {
        const std::int64_t step = first + n;
        const double part = 0.25 * pe_at(step);
        block.pe[static_cast<std::size_t>(n)] = part;
        block.pe[static_cast<std::size_t>(block.count + n)] = pe_at(step) - part;
        if (step > 0 && settings.records_slip()) add_contacts(step);
        if (settings.finds_ruptures()) block.friction.push_back(step > 0 ? friction_at(step) : 0.0);
        if (!settings.records_slip() || !grid.ends_interval(step)) continue;
        block.intervals.insert(block.intervals.end(), sums.begin(), sums.end());
        std::fill(sums.begin(), sums.end(), 0.0);
      }
      stream->add_block(block, [this](std::int64_t step) { return clock.at(step); });
    }
    stream->flush();
  }
};

class EventStreamFiles : public unit::Files {
 protected:
  EventSettings pe_settings(const std::string &name, bool location = false) const {
    EventSettings s;
    s.location = location;
    s.fraction = 0.5;
    s.interval = 4;
    s.modulus = 0.4;
    s.name = "events";
    s.picker.lambda = 0.5;
    s.catalogue_file = path(name + ".csv");
    s.series_file = path(name + ".pe");
    s.series_stride = 2;
    return s;
  }
  EventSettings rupture_settings(const std::string &name) const {
    EventSettings s = pe_settings(name);
    s.ruptures_file = path(name + ".ruptures.csv");
    s.history_file = path(name + ".slip");
    s.gap = 0;
    s.driving = 0.001;
    s.quiet = 3;
    return s;
  }
  void expect_same_files(const EventSettings &a, const EventSettings &b) const {
    EXPECT_EQ(unit::slurp(a.catalogue_file), unit::slurp(b.catalogue_file));
    EXPECT_EQ(unit::slurp(a.series_file), unit::slurp(b.series_file));
    if (!a.history_file.empty()) {
      EXPECT_EQ(unit::slurp(a.ruptures_file), unit::slurp(b.ruptures_file));
      EXPECT_EQ(unit::slurp(a.history_file), unit::slurp(b.history_file));
    }
  }
  static std::vector<LSM::Drop> events_of(const EventSettings &s) {
    return unit::read_catalogue<LSM::Drop>(s.catalogue_file).events;
  }
  /// Events of the first 500 steps, in blocks of so many.
  static std::vector<LSM::Drop> events_after(const EventSettings &s, int block) {
    MadeUpRun run(s);
    run.begin();
    run.run(0, 500, block);
    return events_of(s);
  }
  static std::vector<LSM::PlaneRupture> ruptures_of(const EventSettings &s) {
    return unit::read_catalogue<LSM::PlaneRupture>(s.ruptures_file).events;
  }
};

// After an error within a run nobody knows the slip of the incomplete interval.
TEST_F(EventStreamFiles, WhatWaitsForTheSlipOfAnIntervalIsLeftOutIfThatIsNotKnown) {
  const EventSettings whole = pe_settings("whole", true), cut = pe_settings("cut", true);
  std::size_t most = 0;
  for (std::int64_t steps = 120; steps < 130; ++steps) {
    MadeUpRun known(whole), unknown(cut);
    for (MadeUpRun *one : {&known, &unknown}) {
      one->begin();
      one->run(0, steps, 10);
    }
    known.stream->end_run(steps, known.sums);
    for (MadeUpRun *one : {&known, &unknown}) {
      one->stream->write_rest(false);
      one->stream.reset();
    }
    const auto with = events_of(whole), without = events_of(cut);
    ASSERT_LE(without.size(), with.size());
    most = std::max(most, with.size() - without.size());
    EXPECT_GT(with.back().peak_slip, 0.0);
    for (const EventSettings &one : {whole, cut})
      for (const std::string &file : {one.catalogue_file, one.series_file})
        std::filesystem::remove(file);
  }
  EXPECT_EQ(most, 1U) << "no drop was waiting";
}

TEST_F(EventStreamFiles, CatalogueIsWhatThePickerFindsInTheSeries) {
  MadeUpRun run(pe_settings("a"));
  run.settings.series_stride = 1;
  run.stream = std::make_unique<EventStream>(run.settings);
  run.begin();
  run.run(0, 400, 100);
  const auto series = unit::read_series(run.settings.series_file);
  EXPECT_EQ(series.size(), 401U);
  for (const unit::Sample &one : series) EXPECT_EQ(one.pe, pe_at(one.step));
  const auto events = unit::read_catalogue(run.settings.catalogue_file).events;
  ASSERT_GE(events.size(), 9u);
  unit::expect_same_events(events, unit::picked(series, run.settings.picker));
  EXPECT_EQ(run.stream->drops().events, static_cast<std::int64_t>(events.size()));
}

TEST_F(EventStreamFiles, BlocksLeaveNoTrace) {
  for (const bool ruptures : {false, true}) {
    std::vector<EventSettings> done;
    for (const int block : {1, 7, 100}) {
      const std::string name = (ruptures ? "r" : "p") + std::to_string(block);
      EventSettings settings = ruptures ? rupture_settings(name) : pe_settings(name, true);
      MadeUpRun run(settings);
      run.begin();
      run.run(0, 500, block);
      done.push_back(settings);
      ASSERT_GE(events_of(settings).size(), 5u);
      if (ruptures) {
        ASSERT_GE(ruptures_of(settings).size(), 5u);
      }
    }
    expect_same_files(done[0], done[1]);
    expect_same_files(done[0], done[2]);
  }
}

TEST_F(EventStreamFiles, SlipCountsWhileItsEventIsOpen) {
  const auto events = events_after(pe_settings("a", true), 50);
  ASSERT_GE(events.size(), 5u);
  for (const LSM::Drop &event : events) {
    // Bin b of those that slip moves by 0.02 (b + 1) in each step in which PE falls.
    const auto steps = static_cast<double>(event.step_end - event.step_start);
    const double most = 0.02 * static_cast<double>(6 + event.step_start / 40);
    EXPECT_GT(event.peak_slip, 0.5 * most * steps);
    EXPECT_LE(event.peak_slip, most * steps * (1.0 + 1e-6));
    EXPECT_GT(event.slip_moment, 0.4 * event.peak_slip);  // modulus 0.4, width 1, several bins
    EXPECT_GE(event.rupture_length, 2.0);
    EXPECT_GT(event.x_centroid, 3.5);
    EXPECT_LT(event.x_centroid, static_cast<double>(6 + event.step_start / 40));
  }
}

// Not a share of the intervals of four steps in which a drop begins and ends: slips are shorter.
TEST_F(EventStreamFiles, FrictionOfADropIsThatOfItsSteps) {
  const auto drops = events_after(rupture_settings("a"), 33);
  ASSERT_GE(drops.size(), 10u);
  for (const LSM::Drop &drop : drops) {
    double within = 0.0, total = 0.0;
    for (std::int64_t step = 1; step <= drop.step_end; ++step) {
      total += friction_at(step);
      if (step > drop.step_start) within += friction_at(step);
    }
    EXPECT_EQ(drop.friction_work, within);
    EXPECT_EQ(drop.friction_total, total);
  }
}

TEST_F(EventStreamFiles, GoesOnFromItsStateByteForByte) {
  for (const std::string kind : {"plain", "located", "ruptures", "plane"}) {
    const bool plane = kind == "plane";
    const auto settings = [&](const std::string &name) {
      return kind == "ruptures" || plane ? rupture_settings(name)
                                         : pe_settings(name, kind == "located");
    };
    // The stops are: during loading; within an event; within an interval and a pause; at the end of
    // an event, which is known one step later.
    EventSettings any = settings(kind);
    MadeUpRun ends(any, plane);
    ends.begin();
    ends.run(0, 200, 20);
    const std::int64_t end = events_of(any).at(2).step_end;
    ASSERT_NE(end % 4, 0) << "it ends within an interval";
    for (const std::int64_t stop : {std::int64_t{60}, std::int64_t{75}, std::int64_t{83}, end,
                                    std::int64_t{161}, std::int64_t{236}}) {
      const std::string at = kind + std::to_string(stop);
      SCOPED_TRACE(at);
      EventSettings whole = settings(at);
      MadeUpRun uninterrupted(whole, plane);
      uninterrupted.begin();
      uninterrupted.run(0, 400, 20);

      EventSettings part = settings(at + "part");
      MadeUpRun first(part, plane);
      first.begin();
      first.run(0, stop, 20);
      const std::vector<double> state = first.stream->state(first.sums);
      first.run(stop + 1, stop + 90, 20);  // killed some time after the restart file was written
      first.stream.reset();

      part.resume = true;
      MadeUpRun second(part, plane);
      ASSERT_NO_FATAL_FAILURE(second.restart(stop, state));
      second.run(stop + 1, 400, 20);
      expect_same_files(whole, part);
      ASSERT_GE(events_of(whole).size(), 5u);
      EXPECT_EQ(second.stream->state(second.sums), uninterrupted.stream->state(uninterrupted.sums));
      if (plane) {
        ASSERT_GE(ruptures_of(whole).size(), 5u);
        EXPECT_EQ(ruptures_of(whole)[0].rupture_width, 3.0);
      }
    }
  }
}

TEST_F(EventStreamFiles, NothingIsTouchedThatIsInTheWay) {
  const EventSettings settings = pe_settings("a");
  unit::spill(settings.series_file, "somebody's data");
  MadeUpRun run(settings);
  EXPECT_EQ(unit::message_of<EventStreamError>([&] { run.begin(); }),
            "Compute lsm/events series: file " + settings.series_file +
                " exists; give another name, or replace it with overwrite yes");
  EXPECT_EQ(unit::slurp(settings.series_file), "somebody's data");
  EXPECT_FALSE(std::filesystem::exists(settings.catalogue_file));

  EventSettings resuming = settings;
  resuming.resume = true;
  MadeUpRun without_restart(resuming);
  unit::expect_error<EventStreamError>([&] { without_restart.begin(); },
                                       "holds no picker state of compute events");

  EventSettings replacing = settings;
  replacing.overwrite = true;
  MadeUpRun replaces(replacing);
  replaces.begin();
  EXPECT_NE(unit::slurp(settings.series_file), "somebody's data");
}

TEST_F(EventStreamFiles, RupturesOfOtherBinsDoNotGoOn) {
  EventSettings settings = rupture_settings("a");
  MadeUpRun first(settings);
  first.begin();
  first.run(0, 236, 20);
  SavedStream saved;
  ASSERT_TRUE(saved.read(first.stream->state(first.sums), 0));
  const auto events = first.stream->drops().events, ruptures = first.stream->ruptures().events;
  ASSERT_GT(events, 0);
  ASSERT_GT(ruptures, 0);
  first.stream.reset();

  settings.bin_width = 2.0;
  settings.resume = true;
  MadeUpRun second(settings);
  EXPECT_TRUE(saved.continues_with(first.grid, true));
  EXPECT_FALSE(saved.continues_with(first.grid, false));
  EXPECT_FALSE(saved.continues_with(second.grid, true));
  second.stream->set_state(saved);
  EXPECT_EQ(second.stream->drops().events, events);  // numbering continues
  EXPECT_EQ(second.stream->ruptures().events, ruptures);
  EXPECT_EQ(second.stream->open_ruptures(), 0);
  unit::expect_error<EventStreamError>(
      [&] { second.stream->begin_files(236, true, second.scene, second.clock); },
      "holds no slip of compute events with these bins");
}

TEST_F(EventStreamFiles, DamagedStatesAreRefused) {
  constexpr std::size_t picker_words = sizeof(LSM::PickerState) / sizeof(double);
  MadeUpRun run(rupture_settings("a"));
  run.begin();
  run.run(0, 236, 20);
  ASSERT_GT(run.stream->open_ruptures(), 0);
  std::vector<double> state = run.stream->state(run.sums);
  SavedStream saved;
  EXPECT_TRUE(saved.read(state, 0));
  for (const std::size_t length_left :
       {std::size_t{0}, picker_words - 1, picker_words + 4, state.size() - 1})
    EXPECT_FALSE(saved.read({state.begin(), state.begin() + static_cast<long>(length_left)}, 0))
        << length_left;
  state.push_back(0.0);
  EXPECT_FALSE(saved.read(state, 0));
  state.pop_back();

  // The lists have the right lengths, but no fault can have written them.
  ASSERT_TRUE(saved.read(state, 0));
  saved.finder.back() = 1000.0;
  MadeUpRun other(rupture_settings("b"));
  EXPECT_THROW(other.stream->set_state(saved), std::invalid_argument);
}

TEST_F(EventStreamFiles, TheSeriesEndsBeforeAnEnergyThatIsNotFinite) {
  EventSettings settings = pe_settings("a");
  settings.series_stride = 1;
  MadeUpRun run(settings);
  run.begin();
  GatheredBlock block;
  block.count = 3;
  block.pe = std::vector<double>{1.0, 2.0, std::numeric_limits<double>::quiet_NaN()};
  const std::string message = unit::message_of<EventStreamError>([&] {
    run.stream->add_block(block, [](std::int64_t step) { return 0.5 * static_cast<double>(step); });
  });
  EXPECT_TRUE(unit::contains(message, "Potential energy is not finite at step 2"));
  EXPECT_EQ(unit::read_series(settings.series_file).size(), 2U);  // of a run that still exists
}

TEST(EventStream, WhatTheOutsideChangesIsNoEvent) {
  EventSettings settings;
  settings.picker.lambda = 0.5;
  EventStream stream(settings);
  const auto add = [&](std::int64_t first, const std::vector<double> &pe) {
    GatheredBlock block;
    block.first = first;
    block.count = static_cast<int>(pe.size());
    block.pe = pe;
    stream.add_block(block, [](std::int64_t step) { return static_cast<double>(step); });
  };
  add(0, {10.0, 11.0, 12.0});
  const double rate = stream.picker().rate();
  stream.leave_out_jump(-8.0);
  add(3, {5.0});
  EXPECT_FALSE(stream.picker().in_event());
  EXPECT_EQ(stream.picker().rate(), 0.5 * rate + 0.5);
  // Half the time step means half the rate per step.
  const double before = stream.picker().rate();
  settings.picker.lambda = 0.75;
  stream.change_picker(settings.picker, 0.5);
  EXPECT_EQ(stream.picker().rate(), 0.5 * before);
  add(4, {5.0});
  EXPECT_EQ(stream.picker().rate(), 0.75 * 0.5 * before);
}

TEST(EventStream, AJumpWithinAnEventIsNoPartOfItsSize) {
  EventSettings settings;
  settings.picker.lambda = 0.5;
  EventStream smooth(settings), jumps(settings);
  for (std::int64_t step = 0; step < 60; ++step) {
    const bool after = step > 33;
    GatheredBlock block;
    block.first = step;
    block.count = 1;
    const auto time_of = [](std::int64_t s) { return static_cast<double>(s); };
    block.pe = std::vector<double>{pe_at(step)};
    smooth.add_block(block, time_of);
    block.pe = std::vector<double>{pe_at(step) - (after ? 8.0 : 0.0)};
    jumps.add_block(block, time_of);
    if (step != 33) continue;
    ASSERT_TRUE(jumps.picker().in_event());
    jumps.leave_out_jump(-8.0);
  }
  ASSERT_GT(smooth.drops().events, 0);
  EXPECT_EQ(jumps.drops().events, smooth.drops().events);
  EXPECT_NEAR(jumps.drops().last_size, smooth.drops().last_size, 1e-12);
}

TEST(EventSettings, HeadersSayEachParameterOnce) {
  EventSettings settings;
  settings.parameters = {{"seed", "3"}, {"links", "many"}};
  settings.no_series = true;
  const LSM::SceneInfo scene{{{"program", "p"}, {"links", "7"}, {"dt", "0.5"}}, 2, 0.5};
  const auto pe = LSM::drops_header(settings, scene, {});
  EXPECT_EQ(*pe.find("links"), "many");  // the user's lines stay, after the others
  EXPECT_EQ(pe.parameters.back().first, "links");
  EXPECT_EQ(*pe.find("ranks"), "2");
  EXPECT_EQ(*pe.find("series"), "none");
  EXPECT_NE(pe.find("picker"), nullptr);
  EXPECT_EQ(pe.find("slip_bin"), nullptr);
  EXPECT_TRUE(pe.columns.empty());
  // The series is the same whether slip is recorded or not; lines that it has anyway are not
  // repeated.
  const auto series = LSM::series_header(settings, scene, {100.0, 50, 0.5});
  EXPECT_EQ(series.find("dt"), nullptr);
  EXPECT_EQ(series.time(60), 105.0);

  settings.ruptures_file = "r.csv";
  settings.driving = 0.0005;
  settings.modulus = 0.4;
  FaultGrid grid;
  grid.width = 1.25;
  const auto located = LSM::drops_header(settings, scene, grid);
  EXPECT_EQ(*located.find("slip_bin"), "1.25");
  EXPECT_EQ(*located.find("modulus"), "0.40000000000000002");
  EXPECT_TRUE(located.has("slip_moment") && located.has("peak_slip"));
  EXPECT_TRUE(located.has("friction_work") && located.has("friction_total"));
  EXPECT_FALSE(located.has("stress_drop"));
  EventSettings faces_only = settings;
  faces_only.ruptures_file.clear();
  faces_only.location = true;
  const auto without = LSM::drops_header(faces_only, scene, grid);
  EXPECT_TRUE(without.has("peak_slip"));
  EXPECT_FALSE(without.has("friction_work")) << "contacts are recorded for ruptures only";
  const auto ruptures = LSM::ruptures_header(settings, scene, grid);
  EXPECT_EQ(*ruptures.find("slip_bin"), "1.25");
  EXPECT_EQ(*ruptures.find("slip_velocity"), "0.0025000000000000001");
  EXPECT_EQ(ruptures.find("picker"), nullptr);
  EXPECT_EQ(ruptures.find("series"), nullptr);
  EXPECT_TRUE(ruptures.has("stress_drop") && ruptures.has("peak_slip"));
  EXPECT_FALSE(ruptures.has("z_begin"));
  EXPECT_EQ(ruptures.find("slip_bin_dip"), nullptr);
  EXPECT_EQ(LSM::series_header(settings, scene, {100.0, 50, 0.5}).parameters, series.parameters);

  // On a plane drops of PE are not located.
  grid.plane = true;
  const auto drops = LSM::drops_header(settings, scene, grid);
  EXPECT_EQ(drops.find("slip_bin"), nullptr);
  EXPECT_FALSE(drops.has("slip_moment"));
  const auto patches = LSM::ruptures_header(settings, scene, grid);
  EXPECT_EQ(*patches.find("slip_bin_dip"), "1");
  EXPECT_TRUE(patches.has("z_begin") && patches.has("slip_moment"));
}

TEST(EventSettings, BinsFillTheFault) {
  EventSettings settings;
  settings.bin_width = 3.0;
  const FaultGrid grid = settings.grid(-5.0, 20.0, 7, 1.0, 0.5);
  EXPECT_EQ(grid.bins, 6);
  EXPECT_DOUBLE_EQ(grid.length(), 20.0);
  settings.bin_width = 0.1;
  EXPECT_EQ(settings.grid(0.0, 0.3, 0, 0.0, 1.0).bins, 3);  // 2.9999999999999996 widths
  settings.bin_width = 50.0;
  EXPECT_EQ(settings.grid(0.0, 20.0, 0, 0.0, 1.0).bins, 1);
  settings.pause = 0.0;
  EXPECT_EQ(settings.rupture_settings(0.5).memory, 1);
  settings.pause = 12.0;
  EXPECT_EQ(settings.rupture_settings(0.5).memory, 2);  // intervals of 10 steps of 0.5
}

}  // namespace
