// SPDX-License-Identifier: GPL-2.0-or-later
// Statements in words: densities that do or do not decrease, coverage of the errors of shares, and
// slip within and between drops by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "input_file.h"
#include "numerics/random.h"
#include "statements.h"
#include "unit_files.h"

namespace {

using namespace LSM;
using namespace LSM::postproc;

/// Contents of bins of width 1 with the given density, in parts of a run with different noise.
std::vector<std::vector<double>> contents(const std::vector<double> &density, Random &random) {
  std::vector<std::vector<double>> out;
  for (int part = 0; part < run_parts; ++part) {
    out.emplace_back();
    for (const double mean : density) out.back().push_back(mean * (0.7 + 0.6 * random.uniform()));
  }
  return out;
}

TEST(Statements, MonotonyTellsARiseFromNoise) {
  const std::vector<double> edges = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  Random random(3);
  int alarms = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // For a flat density the largest of 28 ratios is above 1 by chance.
    const Monotony flat = monotony(edges, contents(std::vector<double>(8, 2.0), random));
    EXPECT_GT(flat.rise.value, 1.0);
    alarms += flat.rises;
  }
  EXPECT_LE(alarms, 20);  // 5 % of 200, and three standard errors

  const Monotony bump =
      monotony(edges, contents({8.0, 4.0, 2.9, 3.9, 2.0, 1.0, 0.5, 0.25}, random));
  EXPECT_TRUE(bump.rises);
  EXPECT_DOUBLE_EQ(bump.rises_from, 2.5);
  EXPECT_DOUBLE_EQ(bump.rises_to, 3.5);
  EXPECT_NEAR(bump.rise.value, 3.9 / 2.9, 3.0 * bump.rise.error);
  EXPECT_LT(bump.rise.error, 0.15);
  double sum = 0.0;
  for (const Measured &bin : bump.density) sum += bin.value;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_FALSE(monotony(edges, contents({8, 7, 6, 5, 4, 3, 2, 1}, random)).rises);
}

TEST(Statements, MonotonyIsOfDensitiesAndNeedsContent) {
  // Twice the content in a bin of three times the width is no rise.
  std::vector<std::vector<double>> parts(run_parts, {1.0, 2.0});
  const Monotony wide = monotony({0.0, 1.0, 4.0}, parts);
  EXPECT_FALSE(wide.rises);
  EXPECT_NEAR(wide.rise.value, 2.0 / 3.0, 1e-12);
  // A bin with content in a single part is ignored.
  for (std::size_t k = 1; k < parts.size(); ++k) parts[k][1] = 0.0;
  parts[0][1] = 1000.0;
  EXPECT_TRUE(std::isnan(monotony({0.0, 1.0, 4.0}, parts).rise.value));
}

TEST(Statements, RatiosOfPartsCover) {
  Random random(11);
  int covered = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> above, below;
    for (int part = 0; part < run_parts; ++part) {
      // Events are clustered: a part has few or many, of which 0.3 on average count.
      const double many = 1.0 + 4.0 * random.uniform();
      below.push_back(many);
      above.push_back(many * (0.2 + 0.2 * random.uniform()));
    }
    const Measured ratio = ratio_of_parts(above, below);
    covered += std::fabs(ratio.value - 0.3) < ratio.error;
  }
  EXPECT_NEAR(covered / 300.0, 0.67, 0.09);  // Student's t of 19 degrees: 0.67
}

class SlipAndDrops : public unit::Files {};

TEST_F(SlipAndDrops, AddUpByHand) {
  // 100 cycles of 8 quiet intervals of one time unit, at a tenth of the plate velocity, and a drop
  // that lasts 2 intervals, at 10 and 30 plate velocities in the two bins of width 3.
  SlipHistoryInfo info;
  info.grid.bins = 2;
  info.grid.width = 3.0;
  info.grid.interval = 4;
  info.grid.dt = 0.25;
  info.ruptures.velocity = 0.005;
  info.driving = 0.001;
  info.quiet = 8;
  SlipHistoryWriter writer;
  FaultRow row(2);
  row.stress = {0.01F, 0.03F};
  writer.create(path("slip.bin"), info, 0, 0.0, row.stress);
  std::vector<Event> drops;
  for (int cycle = 0; cycle < 100; ++cycle)
    for (int n = 0; n < 10; ++n) {
      const std::int64_t interval = 10 * cycle + n;
      const bool slips = n >= 8;
      row.slip = {slips ? 0.01F : 1e-4F, slips ? 0.03F : 1e-4F};
      writer.add(4 * (interval + 1), 0.0, row, slips);
      if (n != 8) continue;
      Event drop;
      drop.t_start = static_cast<double>(interval);
      drop.t_end = drop.t_start + 2.0;
      drop.size = cycle % 2 == 0 ? 1.0 : 2.0;
      drop.pe_start = 5.0;
      drop.pe_end =
          drop.pe_start - 8 * 0.9 * (0.02 * 6.0 * 0.001);  // rises again by 0.9 of the work
      drops.push_back(drop);
    }
  writer.close();
  SlipHistoryReader reader = open_history(path("slip.bin"), false);
  const SlipStatements s = slip_statements(reader, drops, 0.5);
  EXPECT_NEAR(s.time, 992.0, 1e-9);
  EXPECT_NEAR(s.time_between, 99.0 * 8 / 992, 1e-9);
  EXPECT_NEAR(s.single, 200.0 / 992, 1e-9);
  EXPECT_NEAR(s.rate_between.value, 0.1, 1e-6);
  EXPECT_NEAR(s.rate_within.value, 200.0, 1e-3);
  const double slip_between = 99 * 8 * 1e-4, slip_within = 200 * 0.02;
  EXPECT_NEAR(s.slip_between.value, slip_between / (slip_between + slip_within), 1e-6);
  EXPECT_NEAR(s.rise_over_work.value, 0.9, 1e-5);
  EXPECT_NEAR(s.recorded.value, (slip_between + slip_within) / (992 * 0.001), 1e-6);
  EXPECT_EQ(s.backwards, 0.0);
  // There are three velocities: 0.1 (also as a mean over eight intervals), 10 and 30.
  EXPECT_EQ(s.velocities.density.size(), 14U);
  EXPECT_FALSE(s.velocities.rises);
  // Half of the drops are too small, which doubles the time between drops.
  SlipHistoryReader again = open_history(path("slip.bin"), false);
  const SlipStatements large = slip_statements(again, drops, 1.5);
  EXPECT_NEAR(large.time_between, 49.0 * 18 / 982, 1e-9);

  SlipHistoryReader third = open_history(path("slip.bin"), false);
  EXPECT_THROW(slip_statements(third, drops, 3.0), std::runtime_error);
}

TEST(Statements, ShareOfOneBin) {
  EventTable table;
  table.info.rupture_length = true;
  table.info.parameters = {{"slip_bin", "2"}};
  for (int i = 0; i < 400; ++i) {
    Event event;
    event.t_start = i;
    event.rupture_length = i % 4 == 0 ? 6.0 : 2.0;
    table.details.push_back(event);
  }
  const Measured share = share_of_one_bin(table);
  EXPECT_DOUBLE_EQ(share.value, 0.75);
  EXPECT_LT(share.error, 1e-6);
  table.info.parameters.clear();
  EXPECT_THROW(share_of_one_bin(table), std::runtime_error);
}

TEST(Statements, RollOffFindsItsPower) {
  // s^-1.2 exp(-(s / 0.1)^power) above 1e-4, sampled by rejection from a power law up to 10.
  for (const double power : {1.0, 2.5}) {
    Random random(29);
    EventTable table;
    while (table.events.size() < 8000) {
      const double lo = std::pow(1e-4, -0.2), hi = std::pow(10.0, -0.2);
      const double size = std::pow(lo + random.uniform() * (hi - lo), -5.0);
      if (random.uniform() > std::exp(-std::pow(size / 0.1, power))) continue;
      EventSummary shock;
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

}  // namespace
