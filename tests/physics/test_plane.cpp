// SPDX-License-Identifier: GPL-2.0-or-later
// Ruptures and slip history of a plane, by compute lsm/events in three dimensions: prescribed slip,
// spheres that slide to rest, restart.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "facing_spheres.h"
#include "fault_scene.h"
#include "read_catalogue.h"
#include "read_series.h"
#include "same_events.h"

using namespace physics;

using Plane = Lmp;

/// Eight by six upper spheres (IDs 49 to 96), each right above a lower one (IDs 1 to 48, along z
/// first) with an overlap of 0.01. The box is periodic along x.
static std::string upper_and_lower(const std::string &compute) {
  return facing_spheres(8, 6, "dimension         3\nboundary          p f f", "0 16 -10 10 -12 0") +
         compute + "\n";
}

static std::string events(const std::string &more) {
  return "compute           events all lsm/events sides below above faces lowerface upperface "
         "driving 0.001 slipping 5 interval 10 bin 2 gap 0 pause 1 quiet 4 block 7 overwrite yes " +
         more;
}

struct Motion {
  int bin, row;
  double strike, dip;
};

/// Moves the upper sphere of each given cell at its velocity for 10 steps.
static std::string moved(const std::vector<Motion> &motions) {
  std::string script, after;
  for (const Motion &m : motions) {
    const std::string id = std::to_string(49 + 6 * m.bin + m.row), name = "m" + id;
    script += "group " + name + " id " + id + "\nfix " + name + " " + name + " move linear " +
              text(m.strike) + " 0 " + text(m.dip) + "\n";
    after += "unfix " + name + "\ngroup " + name + " delete\n";
  }
  return script + "run 10\n" + after;
}

// An interval lasts 1, so that velocities are slips.
TEST_F(Plane, PrescribedSlipIsFoundOnAnyNumberOfRanks) {
  const std::string script =
      upper_and_lower(
          events("ruptures ${name}.csv history ${name}.slip modulus 0.5 catalogue ${name}.drops")) +
      moved({{0, 0, 0.02, -0.01}, {7, 1, 0.04, -0.02}, {4, 4, 0.003, 0.003}}) +
      moved({{1, 0, 0.0, 0.06}, {4, 4, 0.003, 0.003}}) + moved({{5, 5, -0.03, 0.04}}) + "run 60\n";
  std::vector<LSM::PlaneRupture> first;
  std::vector<LSM::SlipRecord> first_records;
  const auto check = [&](Variables variables, int ranks) {
    variables.emplace_back("name", "moved");
    ran(script, variables, ranks);
    const auto catalogue = unit::read_catalogue<LSM::PlaneRupture>(path("moved.csv"));
    EXPECT_TRUE(catalogue.info.has("z_begin"));
    const auto drops = unit::read_catalogue<LSM::Drop>(path("moved.drops"));
    EXPECT_EQ(drops.info.columns,
              (std::vector<std::string_view>{"friction_work", "friction_total"}));
    EXPECT_EQ(*catalogue.info.find("slip_bin_dip"), "2");
    ASSERT_EQ(catalogue.events.size(), 2u);
    const LSM::PlaneRupture &a = catalogue.events[0], &b = catalogue.events[1];
    const double close = 1e-6;
    // Cells (7, 1) and (0, 0) share a corner across the seam; (1, 0) follows.
    EXPECT_EQ(a.step_start, 0);
    EXPECT_EQ(a.step_end, 20);
    EXPECT_EQ(a.rupture_area, 12.0);
    EXPECT_EQ(a.rupture_length, 6.0);
    EXPECT_EQ(a.rupture_width, 4.0);
    EXPECT_EQ(a.x_begin, 14.0);
    EXPECT_EQ(a.z_begin, -12.0);
    EXPECT_EQ(a.x_hypocentre, 15.0);
    EXPECT_EQ(a.z_hypocentre, -9.0);
    EXPECT_NEAR(a.moment_strike, 0.5 * 4.0 * 0.06, close);
    EXPECT_NEAR(a.moment_dip, 0.5 * 4.0 * 0.03, close);
    EXPECT_NEAR(a.slip_moment, 2.0 * std::hypot(0.06, 0.03), close);
    EXPECT_NEAR(a.peak_slip, 0.06, close);
    EXPECT_NEAR(a.peak_slip_rate, 0.06, close);
    EXPECT_NEAR(a.mean_slip, std::hypot(0.06, 0.03) / 3.0, close);
    EXPECT_EQ(b.step_start, 20);
    EXPECT_EQ(b.step_end, 30);
    EXPECT_EQ(b.rupture_area, 4.0);
    EXPECT_EQ(b.x_hypocentre, 11.0);
    EXPECT_EQ(b.z_hypocentre, -1.0);
    EXPECT_NEAR(b.x_centroid, 11.0, 1e-9);
    EXPECT_NEAR(b.z_centroid, -1.0, 1e-9);
    EXPECT_NEAR(b.moment_strike, -0.06, close);
    EXPECT_NEAR(b.moment_dip, 0.08, close);
    // A sphere that has moved by d is pushed on by fn d / 2, over a cell of area 4.
    EXPECT_NEAR(b.stress_drop, 0.5 * 0.0097 * 0.05 / 4.0, 0.05 * 6e-5);
    // The work of friction is mu fn slip, with fn = 0.0098 on the mean, and half of that in the
    // first of 10 steps.
    EXPECT_NEAR(b.size, 1e-5 * 0.0098 * 0.05 * 0.95, 0.01 * 4.6e-9);

    const auto records = unit::read_history(path("moved.slip")).records;
    double strike = 0.0, dip = 0.0;
    for (const LSM::SlipRecord &record : records)
      for (std::size_t k = 0; k < record.row.work.size(); ++k) {
        strike += static_cast<double>(record.row.slip[2 * k]);
        dip += static_cast<double>(record.row.slip[2 * k + 1]);
      }
    EXPECT_NEAR(strike, 0.06 + 0.006 - 0.03, close);
    EXPECT_NEAR(dip, 0.03 + 0.006 + 0.04, close);
    std::vector<LSM::PlaneRupture> events = catalogue.events;
    if (first.empty()) {
      first = events;
      first_records = records;
    }
    for (std::size_t n = 0; n < 2; ++n) {
      events[n].pe_start = first[n].pe_start;
      events[n].pe_end = first[n].pe_end;
    }
    unit::expect_same_events(events, first);
    ASSERT_EQ(records.size(), first_records.size());
    for (std::size_t n = 0; n < records.size(); ++n) {
      EXPECT_EQ(records[n].row.slip, first_records[n].row.slip);
      EXPECT_EQ(records[n].row.work, first_records[n].row.work);
      EXPECT_EQ(records[n].row.stress, first_records[n].row.stress);
      EXPECT_NEAR(records[n].pe, first_records[n].pe, 1e-13 * first_records[n].pe);
    }
  };
  check({}, 1);
  each_split(check);
}

/// Upper spheres that slide at different velocities until friction and drag stop them; their
/// distance from the lower ones is kept.
static std::string sliding(const std::string &prefix) {
  return "pair_coeff        1 2 1.0 1.0 0.6\nfix move above nve\nfix drag above viscous 0.3\nfix keep above setforce NULL 0 NULL\n" +
         events("catalogue " + prefix + ".drops series " + prefix + ".pe ruptures " + prefix +
                ".csv history " + prefix + ".slip modulus 0.5 resume yes") +
         "\n";
}

static std::string pushed() {
  std::string script;
  for (const Motion &m :
       std::vector<Motion>{{1, 1, 0.1, 0.02}, {2, 1, 0.05, 0.04}, {6, 4, -0.02, -0.07}})
    script += "set atom " + std::to_string(49 + 6 * m.bin + m.row) + " vx " + text(m.strike) +
              " vz " + text(m.dip) + "\n";
  return script;
}

// The restart file is written within an interval, with ruptures open.
TEST_F(Plane, RunsGoOnByteForByte) {
  for (int ranks : {1, 2}) {
    SCOPED_TRACE(ranks);
    const std::string tag = std::to_string(ranks), whole = "whole" + tag, part = "part" + tag;
    const auto first = [&](const std::string &prefix, int more) {
      return upper_and_lower("") + pushed() + sliding(prefix) + "run 34\nwrite_restart " + prefix +
             ".restart\nrun " + std::to_string(more) + "\n";
    };
    ran(first(whole, 266), {}, ranks);
    ran(first(part, 100), {}, ranks);
    const std::string again =
        "newton off\natom_style hybrid bond sphere\natom_modify map array\ncomm_modify mode single "
        "cutoff 4.5\nread_restart " +
        part +
        ".restart\nneighbor 0.4 bin\nneigh_modify delay 0 every 1 check yes\n"
        "thermo 1000\n" +
        sliding(part) + "run 266\n";
    ran(again, {}, ranks);
    for (const char *ending : {".csv", ".slip", ".pe", ".drops"})
      EXPECT_EQ(read_file(path(whole + ending)), read_file(path(part + ending))) << ending;
    const auto found = unit::read_catalogue<LSM::PlaneRupture>(path(whole + ".csv")).events;
    ASSERT_GE(found.size(), 2u);
    bool open = false;
    for (const LSM::Event &e : found) open = open || (e.step_start < 34 && e.step_end > 34);
    EXPECT_TRUE(open);
    EXPECT_GE(found.back().rupture_area, 4.0);
  }
}

TEST_F(Plane, OneLineOfError) {
  const struct {
    std::string lines;
    std::vector<std::string> parts;
  } cases[] = {
      {events("location yes"), {"keyword location needs dimension 2"}},
      {events("ruptures r.csv modulus 1 fraction 0.1"), {"keyword fraction needs dimension 2"}},
      {events("ruptures r.csv") + "\nrun 1",
       {"ruptures needs the keyword modulus in three dimensions"}},
      {events("history h.bin modulus 1 bin 1e-4") + "\nrun 1",
       {"bin 0.0001 makes 19200000000 bins of a box of length 16 and depth 12, expected at most 1048576"}},
      {events("ruptures r.csv modulus 1") + "\nfix d all deform 1 z scale 1.1\nrun 1",
       {"fix d changes the box along z, which ruptures cannot follow"}},
      {events("ruptures r.csv modulus 1") + "\nrun 1\nchange_box all z final -12 1\nrun 1",
       {"the box along z was -12 to 0 when it began and is -12 to 1 now"}}};
  for (const auto &one : cases) {
    SCOPED_TRACE(one.lines);
    refused(one.parts, upper_and_lower(one.lines));
  }
}
