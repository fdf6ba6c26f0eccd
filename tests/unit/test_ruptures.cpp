// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "numerics/random.h"
#include "same_events.h"
#include "slow_ruptures.h"
#include "some_ruptures.h"

namespace {

using LSM::FaultGrid;
using LSM::FaultRow;
using LSM::FaultRupture;
using LSM::Rupture;
using LSM::RuptureFinder;
using LSM::RuptureSettings;
using unit::some_grid;
using unit::some_settings;

/// One line per interval, one character per bin; a digit is the slip of the bin in hundredths.
using Pattern = std::vector<std::string>;

/// Work is a tenth of the slip; the stress of bin b after interval n is 1 - n / 100 + b / 1000, and
/// PE is -n.
FaultRow row_of(const std::string &line, int n) {
  FaultRow row(static_cast<int>(line.size()));
  for (std::size_t b = 0; b < line.size(); ++b) {
    if (line[b] != '.') row.slip[b] = 0.01F * static_cast<float>(line[b] - '0');
    row.work[b] = 0.1F * row.slip[b];
    row.stress[b] = 1.0F - 0.01F * static_cast<float>(n) + 0.001F * static_cast<float>(b);
  }
  return row;
}

/// Finds the ruptures of a pattern.
/// \param restarts whether to restore the finder from its state after each interval
std::vector<Rupture> find(Pattern pattern, const FaultGrid &grid, const RuptureSettings &settings,
                          bool restarts = false) {
  std::vector<Rupture> events;
  RuptureFinder finder(grid, settings);
  const std::string quiet(static_cast<std::size_t>(grid.bins), '.');
  finder.begin(grid.time(grid.step0), 0.0, row_of(quiet, 0));
  for (std::int64_t k = 0; k <= settings.memory; ++k) pattern.push_back(quiet);
  int n = 0;
  for (const std::string &line : pattern) {
    ++n;
    finder.add(grid.time(grid.step0 + n * grid.interval), -n, row_of(line, n),
               [&](const FaultRupture &r) { events.push_back(finder.rupture(r)); });
    if (!restarts) continue;
    const std::vector<double> state = finder.state();
    finder = RuptureFinder(grid, settings);
    finder.set_state(state);
  }
  EXPECT_EQ(finder.open(), 0);
  EXPECT_FALSE(finder.active());
  return events;
}

/// The same pattern as a slip history.
std::vector<LSM::SlipRecord> records_of(Pattern pattern, const FaultGrid &grid,
                                        std::int64_t memory) {
  const std::string quiet(static_cast<std::size_t>(grid.bins), '.');
  pattern.insert(pattern.begin(), quiet);
  for (std::int64_t k = 0; k < memory; ++k) pattern.push_back(quiet);
  std::vector<LSM::SlipRecord> records;
  for (std::size_t n = 0; n < pattern.size(); ++n) {
    LSM::SlipRecord r;
    r.step_end = grid.step0 + grid.interval * static_cast<std::int64_t>(n);
    r.step_begin = n > 0 ? r.step_end - grid.interval : r.step_end;
    r.pe = -static_cast<double>(n);
    r.row = row_of(pattern[n], static_cast<int>(n));
    records.push_back(r);
  }
  return records;
}

constexpr double rounding = 1e-7;  // relative error of floats

TEST(FaultRuptures, OneWithAllItsNumbers) {
  const std::vector<Rupture> events = find({"..........",  //
                                            "..12......",  //
                                            ".231......",  //
                                            ".1........"},
                                           some_grid(), some_settings());
  ASSERT_EQ(events.size(), 1U);
  const Rupture &e = events[0];
  EXPECT_EQ(e.step_start, 1004);
  EXPECT_EQ(e.step_end, 1016);
  EXPECT_EQ(e.t_start, 51.0);
  EXPECT_EQ(e.t_end, 54.0);
  EXPECT_EQ(e.pe_start, -1.0);
  EXPECT_EQ(e.pe_end, -4.0);
  EXPECT_NEAR(e.size, 0.01, rounding);  // work: a tenth of 0.10
  EXPECT_NEAR(e.slip_moment, 0.5 * 0.10 * 2.0, rounding);
  EXPECT_EQ(e.rupture_length, 6.0);
  EXPECT_EQ(e.x_begin, -3.0);
  EXPECT_EQ(e.x_hypocentre, 2.0);  // bin 3 slips most in the first interval
  EXPECT_NEAR(e.mean_slip, 0.1 / 3.0, rounding);
  EXPECT_NEAR(e.peak_slip, 0.04, rounding);  // of bin 2
  // Slips 3, 4, 3 in the bins 1, 2, 3; the middle one has its centre at 0.
  EXPECT_NEAR(e.x_centroid, 0.0, 1e-6);
  // The stress drop is that from interval 1, before the rupture, to interval 5, the first after it.
  EXPECT_NEAR(e.stress_drop, 0.04, rounding);
}

TEST(FaultRuptures, SlipsBelowTheVelocityDoNotCount) {
  RuptureSettings settings = some_settings();
  settings.velocity = 0.015;
  const std::vector<Rupture> events = find({"11211....."}, some_grid(), settings);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].rupture_length, 2.0);
  EXPECT_NEAR(events[0].slip_moment, 0.5 * 0.02 * 2.0, rounding);
  // A velocity equal to the threshold is not above it: 0.25 is exact as a float and as a double.
  FaultGrid grid = some_grid();
  settings.velocity = 0.25 / grid.duration();
  RuptureFinder finder(grid, settings);
  FaultRow row(grid.bins);
  finder.begin(0.0, 0.0, row);
  row.slip[3] = 0.25F;
  finder.add(0.0, 0.0, row, [](const FaultRupture &) {});
  EXPECT_FALSE(finder.active());
  row.slip[3] = std::nextafter(0.25F, 1.0F);
  finder.add(0.0, 0.0, row, [](const FaultRupture &) {});
  EXPECT_TRUE(finder.active());
}

TEST(FaultRuptures, BackwardSlipCountsAndIsTakenOff) {
  FaultGrid grid = some_grid();
  RuptureFinder finder(grid, some_settings());
  FaultRow row(grid.bins);
  finder.begin(0.0, 0.0, row);
  row.slip[4] = 0.5F;
  row.slip[5] = -0.25F;
  std::vector<Rupture> events;
  const auto keep = [&](const FaultRupture &r) { events.push_back(finder.rupture(r)); };
  finder.add(0.0, 0.0, row, keep);
  finder.add(0.0, 0.0, FaultRow(grid.bins), keep);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].slip_moment, 0.5 * 2.0 * 0.25);
  EXPECT_EQ(events[0].rupture_length, 4.0);
  EXPECT_EQ(events[0].peak_slip, 0.5);
}

TEST(FaultRuptures, GapsAndMemoryConnect) {
  const Pattern hole = {"1..1......"};
  EXPECT_EQ(find(hole, some_grid(), some_settings(1)).size(), 2U);
  const std::vector<Rupture> bridged = find(hole, some_grid(), some_settings(2));
  ASSERT_EQ(bridged.size(), 1U);
  EXPECT_EQ(bridged[0].rupture_length, 8.0);
  EXPECT_NEAR(bridged[0].mean_slip, 0.02 / 4.0, rounding);

  const Pattern pause = {"1.........", "..........", "1........."};
  EXPECT_EQ(find(pause, some_grid(), some_settings(0, 1)).size(), 2U);
  EXPECT_EQ(find(pause, some_grid(), some_settings(0, 2)).size(), 1U);

  // The gap across the seam counts, too: ends no farther apart than a gap close the ring.
  const std::vector<Rupture> seam = find({"1.......1."}, some_grid(), some_settings(1));
  ASSERT_EQ(seam.size(), 1U);
  EXPECT_EQ(seam[0].x_begin, 11.0);
  EXPECT_EQ(seam[0].rupture_length, 6.0);
  const std::vector<Rupture> round = find({"1.1.1.1.1."}, some_grid(), some_settings(1));
  ASSERT_EQ(round.size(), 1U);
  EXPECT_EQ(round[0].rupture_length, 20.0);
}

TEST(FaultRuptures, RandomPatternsAgreeWithASearch) {
  LSM::Random random(7);
  std::size_t several = 0, holes = 0;
  for (const int bins : {1, 2, 3, 7, 30})
    for (const double density : {0.03, 0.1, 0.3})
      for (const int gap : {0, 1, 3})
        for (const std::int64_t memory : {1, 3})
          for (int trial = 0; trial < 6; ++trial) {
            const FaultGrid grid = some_grid(bins);
            const RuptureSettings settings = some_settings(gap, memory);
            Pattern pattern(50, std::string(static_cast<std::size_t>(bins), '.'));
            for (std::string &line : pattern)
              for (char &c : line)
                if (random.uniform() < density)
                  c = static_cast<char>('1' + static_cast<int>(9.0 * random.uniform()));
            LSM::SlipHistoryInfo info;
            info.grid = grid;
            info.ruptures = settings;
            const unit::SlowRuptures slow =
                unit::slow_ruptures(info, records_of(pattern, grid, memory));
            if (slow.events.size() > 2) ++several;
            double moment = 0.0;
            for (const Rupture &e : slow.events) moment += e.slip_moment;
            ASSERT_NEAR(moment, settings.modulus * grid.width * slow.slip_in_ruptures, 1e-9);
            ASSERT_EQ(slow.slip_elsewhere, 0.0);
            for (const bool restarts : {false, true}) {
              const std::vector<Rupture> found = find(pattern, grid, settings, restarts);
              std::vector<Rupture> expected = slow.events;
              for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k) {
                const Rupture &one = found[k];
                if (gap > 0 && one.rupture_length < bins * grid.width) ++holes;
                EXPECT_GE(one.x_centroid, grid.x0);
                EXPECT_LT(one.x_centroid, grid.x0 + grid.length());
                // Several may slip most at first; where slips around the ring may balance, the
                // centroid is any.
                expected[k].x_hypocentre = one.x_hypocentre;
                if (one.rupture_length >= bins * grid.width / 2)
                  expected[k].x_centroid = one.x_centroid;
              }
              unit::expect_same_events(found, expected, 1e-12, 1e-9, grid.length());
              if (HasFailure()) return;
            }
          }
  EXPECT_GT(several, 100U);
  EXPECT_GT(holes, 100U);
}

TEST(FaultRuptures, HypocentreIsWhereMostSlippedFirst) {
  // The two ruptures of the first interval meet later; the one that slipped more has the
  // hypocentre.
  const std::vector<Rupture> events = find({"3...5.....",  //
                                            "91.19.....",  //
                                            ".111......"},
                                           some_grid(), some_settings());
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].x_hypocentre, 4.0);
  EXPECT_EQ(events[0].rupture_length, 10.0);

  // A later rupture does not get the hypocentre, however much it slips in its first interval.
  const std::vector<Rupture> later = find({"..1.......",  //
                                           "..1..9....",  //
                                           "..1111...."},
                                          some_grid(), some_settings());
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0].x_hypocentre, 0.0);
}

TEST(FaultRuptures, ImpossibleSettingsAndStatesAreRefused) {
  EXPECT_THROW(RuptureFinder(some_grid(), some_settings(-1)), std::invalid_argument);
  EXPECT_THROW(RuptureFinder(some_grid(), some_settings(0, 0)), std::invalid_argument);
  RuptureFinder finder(some_grid(), some_settings());
  finder.begin(0.0, 0.0, row_of("..........", 0));
  finder.add(0.0, 0.0, row_of("12........", 1), [](const FaultRupture &) {});
  const std::vector<double> state = finder.state();
  RuptureFinder other(some_grid(9), some_settings());
  EXPECT_THROW(other.set_state(state), std::invalid_argument);
  for (std::size_t n = 0; n < state.size(); ++n)
    EXPECT_THROW(finder.set_state({state.begin(), state.begin() + static_cast<long>(n)}),
                 std::invalid_argument);
  EXPECT_NO_THROW(finder.set_state(state));
}

// ---- faces and contacts to bins ----

using Contacts = std::vector<LSM::FaultContact>;
using Faces = std::vector<LSM::FaceDisplacement>;

TEST(SlipRecorder, SlipOfTheFacesWorkAndStressOfTheContacts) {
  const FaultGrid grid = some_grid();
  LSM::SlipRecorder sums;
  sums.begin(grid, 1.0);
  // There are two contacts in bin 2 in each of 4 steps, one of which two ranks have.
  for (int step = 0; step < 4; ++step)
    sums.add(Contacts{{-0.5, 0.002, 0.1, 1.0}, {0.5, 0.006, 0.3, 0.5}, {0.5, 0.006, 0.3, 0.5}});
  // The upper face moves in bins 2 (two particles) and 9, the lower one has a particle in bin 5.
  sums.add(Faces{{-0.5, 0.05, 4.0, true},
                 {0.5, 0.03, 4.0, true},
                 {14.9 - 20.0, 0.008, 4.0, true},
                 {5.5, -0.01, 4.0, false}});
  const FaultRow row = LSM::fault_row(grid, sums.sums().data(), 4);
  EXPECT_FLOAT_EQ(row.slip[2], 0.04F + 0.01F);
  EXPECT_FLOAT_EQ(row.work[2], 4 * 0.008F);
  EXPECT_FLOAT_EQ(row.stress[2], 0.4F / 2.0F);
  EXPECT_FLOAT_EQ(row.slip[9], 0.008F + 0.01F);
  // In bins without particles of a face, slip is interpolated linearly, across the seam, too.
  EXPECT_FLOAT_EQ(row.slip[3], 0.04F - 0.032F / 7.0F + 0.01F);
  EXPECT_FLOAT_EQ(row.slip[8], 0.008F + 0.032F / 7.0F + 0.01F);
  EXPECT_FLOAT_EQ(row.slip[0], 0.008F + 0.032F / 3.0F + 0.01F);
  EXPECT_FLOAT_EQ(row.slip[1], 0.008F + 2.0F * 0.032F / 3.0F + 0.01F);
  EXPECT_EQ(row.work[3], 0.0F);
  EXPECT_EQ(row.stress[3], 0.0F);
}

// Slip that is added in two parts within an interval (when a restart file is written in between) is
// the same.
TEST(SlipRecorder, PartsOfAnIntervalAddUp) {
  LSM::SlipRecorder sums;
  sums.begin(some_grid(), 1.0);
  sums.add(Faces{{0.0, 0.01, 1.0, true}, {0.2, 0.03, 1.0, true}});
  sums.add(Faces{{0.0, 0.05, 3.0, true}, {0.2, 0.03, 3.0, true}});
  const FaultRow row = LSM::fault_row(some_grid(), sums.sums().data(), 4);
  for (const float slip : row.slip) EXPECT_FLOAT_EQ(slip, 0.06F);
  sums.clear();
  const FaultRow none = LSM::fault_row(some_grid(), sums.sums().data(), 4);
  for (const float slip : none.slip) EXPECT_EQ(slip, 0.0F);
}

TEST(SlipRecorder, EdgesAndPlacesOutsideTheBoxHaveABin) {
  for (const double x : {-5.0, 14.999999999999998, 15.0, 1e9, -1e9, std::nextafter(-5.0, -6.0)}) {
    LSM::SlipRecorder sums;
    sums.begin(some_grid(), 1.0);
    sums.add(Contacts{{x, 1.0, 0.0, 1.0}});
    sums.add(Faces{{x, 0.01, 4.0, true}});
    double work = 0.0, steps = 0.0;
    for (std::size_t b = 0; b < 10; ++b) {
      work += sums.sums()[LSM::fault_fields * b + LSM::WORK];
      steps += sums.sums()[LSM::fault_fields * b + LSM::UPPER_STEPS];
    }
    EXPECT_EQ(work, 1.0) << x;
    EXPECT_EQ(steps, 4.0) << x;
  }
}

}  // namespace
