// SPDX-License-Identifier: GPL-2.0-or-later
// Slip of a plane: sums over its faces and contacts, ruptures as connected cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "events/slip_recorder.h"
#include "numerics/random.h"
#include "slow_ruptures.h"
#include "some_ruptures.h"

namespace {

using LSM::FaultGrid;
using LSM::FaultRow;
using LSM::FaultRupture;
using LSM::PlaneRupture;
using LSM::RuptureFinder;
using LSM::RuptureSettings;
using unit::some_settings;

FaultGrid some_plane(int bins, int rows, bool ring = true, bool ring_dip = false) {
  FaultGrid grid = unit::some_grid(bins);
  grid.plane = true;
  grid.rows = rows;
  grid.z0 = -6.0;
  grid.height = 1.5;
  grid.ring = ring;
  grid.ring_dip = ring_dip;
  return grid;
}

using Contacts = std::vector<LSM::FaultContact>;
using Faces = std::vector<LSM::FaceDisplacement>;

TEST(Plane, SlipWorkAndStressOfACell) {
  const FaultGrid grid = some_plane(4, 3);
  for (const double forward : {1.0, -1.0}) {
    LSM::SlipRecorder sums;
    sums.begin(grid, forward);
    // Cell (1, 2) is from (-3, -3) to (-1, -1.5); one contact there belongs to two ranks.
    for (int step = 0; step < 4; ++step)
      sums.add(Contacts{{-2.0, 0.5, 6.0, 1.0, -2.0, -3.0},
                        {-2.9, 0.25, 3.0, 0.5, -1.6, 9.0},
                        {-2.9, 0.25, 3.0, 0.5, -1.6, 9.0}});
    // Both faces have a particle in every cell; those in (1, 2) move, each by half of the slip.
    Faces faces;
    for (int b = 0; b < 4; ++b)
      for (int k = 0; k < 3; ++k)
        for (const bool upper : {true, false}) {
          const double moves = b != 1 || k != 2 ? 0.0 : upper ? 0.25 : -0.25;
          faces.push_back({-4.0 + 2.0 * b, moves, 4.0, upper, -5.25 + 1.5 * k, -0.5 * moves});
        }
    sums.add(faces);
    const FaultRow row = LSM::fault_row(grid, sums.sums().data(), 4);
    ASSERT_EQ(row.slip.size(), 24u);
    ASSERT_EQ(row.work.size(), 12u);
    ASSERT_EQ(row.stress.size(), 24u);
    for (std::size_t cell = 0; cell < 12; ++cell) {
      const bool it = cell == 1 * 3 + 2;
      EXPECT_EQ(row.slip[2 * cell], it ? static_cast<float>(forward) * 0.5F : 0.0F) << cell;
      EXPECT_EQ(row.slip[2 * cell + 1], it ? -0.25F : 0.0F)
          << "the dip has no direction of driving";
      EXPECT_EQ(row.work[cell], it ? 3.0F : 0.0F);
      EXPECT_FLOAT_EQ(row.stress[2 * cell], it ? static_cast<float>(forward) * 9.0F / 3.0F : 0.0F);
      EXPECT_FLOAT_EQ(row.stress[2 * cell + 1], it ? 6.0F / 3.0F : 0.0F);
    }
  }
}

// Particles at (bin, row) 0, 0 and 2, 0 and, two rows above, at 0, 2 only.
TEST(Plane, CellsWithoutParticlesAreInterpolated) {
  const FaultGrid grid = some_plane(4, 4);
  LSM::SlipRecorder sums;
  sums.begin(grid, 1.0);
  for (const bool upper : {true, false}) {
    const double d = upper ? 1.0 : 0.0;
    sums.add(Faces{{-4.0, d * 1.0, 4.0, upper, -5.25, d * 8.0},
                   {0.0, d * 3.0, 4.0, upper, -5.25, d * 4.0},
                   {-4.0, d * 7.0, 4.0, upper, -2.25, d * 2.0}});
  }
  const FaultRow row = LSM::fault_row(grid, sums.sums().data(), 4);
  const auto slip = [&](int b, int k, int c) {
    return row.slip[static_cast<std::size_t>(2 * (4 * b + k) + c)];
  };
  for (int b = 0; b < 4; ++b) {
    const float first = std::vector<float>{1, 2, 3, 2}[static_cast<std::size_t>(b)];
    const float dip = std::vector<float>{8, 6, 4, 6}[static_cast<std::size_t>(b)];
    EXPECT_FLOAT_EQ(slip(b, 0, 0), first) << "across the seam of the strike";
    EXPECT_FLOAT_EQ(slip(b, 0, 1), dip);
    EXPECT_FLOAT_EQ(slip(b, 1, 0), 0.5F * (first + 7.0F)) << "between rows";
    EXPECT_FLOAT_EQ(slip(b, 1, 1), 0.5F * (dip + 2.0F));
    EXPECT_FLOAT_EQ(slip(b, 2, 0), 7.0F);
    EXPECT_FLOAT_EQ(slip(b, 3, 0), 7.0F) << "the dip has ends";
  }
}

/// A slip of a cell in an interval.
struct Slip {
  std::int64_t interval;
  int bin, row;
  double strike, dip;
};

/// Work is a tenth of the size of the slip; the stress along strike of each cell after interval n
/// is 2 - n / 16, that along dip n / 8; PE is -n.
std::vector<PlaneRupture> find(const std::vector<Slip> &slips, std::int64_t intervals,
                               const FaultGrid &grid, const RuptureSettings &settings,
                               bool restarts = false) {
  std::vector<PlaneRupture> events;
  RuptureFinder finder(grid, settings);
  for (std::int64_t n = 0; n <= intervals + settings.memory + 1; ++n) {
    FaultRow row(grid);
    for (std::size_t cell = 0; cell < row.work.size(); ++cell) {
      row.stress[2 * cell] = 2.0F - static_cast<float>(n) / 16.0F;
      row.stress[2 * cell + 1] = static_cast<float>(n) / 8.0F;
    }
    for (const Slip &s : slips) {
      if (s.interval != n) continue;
      const auto cell = static_cast<std::size_t>(s.bin * grid.rows + s.row);
      row.slip[2 * cell] = static_cast<float>(s.strike);
      row.slip[2 * cell + 1] = static_cast<float>(s.dip);
      row.work[cell] = static_cast<float>(0.125 * std::hypot(s.strike, s.dip));
    }
    const std::int64_t step = grid.step0 + n * grid.interval;
    const auto pe = -static_cast<double>(n);
    if (n == 0)
      finder.begin(grid.time(step), pe, row);
    else
      finder.add(grid.time(step), pe, row,
                 [&](const FaultRupture &r) { events.push_back(finder.plane_rupture(r)); });
    if (!restarts || n == 0) continue;
    const std::vector<double> state = finder.state();
    finder = RuptureFinder(grid, settings);
    finder.set_state(state);
  }
  EXPECT_EQ(finder.open(), 0);
  return events;
}

// Cells (5, 1), (5, 2), (0, 2) of a ring of 6 bins and 4 rows with ends.
TEST(Plane, ARuptureWithAllItsNumbers) {
  const std::vector<PlaneRupture> events = find({{2, 5, 1, 0.375, 0.5},
                                                 {3, 5, 2, 0.25, 0.0},
                                                 {3, 5, 1, 0.0, 0.125},
                                                 {4, 0, 2, 0.125, -0.125}},
                                                4, some_plane(6, 4), some_settings());
  ASSERT_EQ(events.size(), 1u);
  const PlaneRupture &e = events[0];
  EXPECT_EQ(e.step_start, 1004);
  EXPECT_EQ(e.step_end, 1016);
  EXPECT_EQ(e.t_start, 51.0);
  EXPECT_EQ(e.t_end, 54.0);
  EXPECT_EQ(e.pe_start, -1.0);
  EXPECT_EQ(e.pe_end, -4.0);
  EXPECT_NEAR(e.size, 0.125 * (0.625 + 0.25 + 0.125 + std::sqrt(2.0) / 8.0), 1e-8);
  EXPECT_EQ(e.moment_strike, 0.5 * 0.75 * 3.0);
  EXPECT_EQ(e.moment_dip, 0.5 * 0.5 * 3.0);
  EXPECT_DOUBLE_EQ(e.slip_moment, 0.5 * std::hypot(0.75, 0.5) * 3.0);
  EXPECT_EQ(e.rupture_area, 9.0);
  EXPECT_EQ(e.rupture_length, 4.0);
  EXPECT_EQ(e.rupture_width, 3.0);
  EXPECT_EQ(e.x_begin, 5.0);
  EXPECT_EQ(e.z_begin, -4.5);
  EXPECT_EQ(e.x_hypocentre, 6.0);
  EXPECT_EQ(e.z_hypocentre, -3.75);
  EXPECT_DOUBLE_EQ(e.mean_slip, std::hypot(0.75, 0.5) / 3.0);
  EXPECT_DOUBLE_EQ(e.peak_slip, std::hypot(0.375, 0.625));
  EXPECT_EQ(e.peak_slip_rate, 0.625);  // of an interval of 1
  const double first = 0.625 + 0.125, second = 0.25, third = std::sqrt(2.0) / 8.0;
  EXPECT_NEAR(e.z_centroid,
              -6.0 + 1.5 * (first * 1.5 + (second + third) * 2.5) / (first + second + third),
              1e-12);
  // From interval 1 to 5 the stress falls by 1/4 along strike, and rises by 1/2 along dip.
  EXPECT_DOUBLE_EQ(e.stress_drop, (0.25 * 0.75 - 0.5 * 0.5) / std::hypot(0.75, 0.5));
}

TEST(Plane, CornersConnectAndEndsDoNot) {
  const auto count = [](int bin, int row, const FaultGrid &grid, int gap) {
    return find({{1, 0, 0, 1.0, 0.0}, {1, bin, row, 0.0, 1.0}}, 1, grid, some_settings(gap)).size();
  };
  for (const bool ring : {true, false})
    for (const bool ring_dip : {true, false}) {
      const FaultGrid grid = some_plane(7, 8, ring, ring_dip);
      EXPECT_EQ(count(1, 1, grid, 0), 1u);
      EXPECT_EQ(count(2, 1, grid, 0), 2u);
      EXPECT_EQ(count(1, 2, grid, 0), 2u);
      EXPECT_EQ(count(2, 2, grid, 1), 1u);
      EXPECT_EQ(count(6, 0, grid, 0), ring ? 1u : 2u);
      EXPECT_EQ(count(0, 7, grid, 0), ring_dip ? 1u : 2u);
      EXPECT_EQ(count(6, 7, grid, 1), ring && ring_dip ? 1u : 2u);
    }
}

/// Numbers of a rupture, found by a search through space and time.
using Numbers = std::tuple<std::int64_t, std::int64_t, double, double, double, double, double>;

std::vector<Numbers> search(const std::vector<Slip> &slips, const FaultGrid &grid,
                            const RuptureSettings &settings) {
  std::map<unit::Cell, Slip> of;
  std::set<unit::Cell> slides;
  for (const Slip &s : slips) of[*slides.emplace(s.interval, s.bin, s.row).first] = s;
  std::vector<Numbers> found;
  for (const std::set<unit::Cell> &all : unit::connected(slides, grid, settings)) {
    std::set<int> bins, rows, cells;
    double strike = 0.0, dip = 0.0;
    for (const unit::Cell &one : all) {
      const Slip &s = of.at(one);
      bins.insert(s.bin);
      rows.insert(s.row);
      cells.insert(s.bin * grid.rows + s.row);
      strike += s.strike;
      dip += s.dip;
    }
    found.emplace_back(std::get<0>(*all.begin()) - 1, std::get<0>(*all.rbegin()),
                       static_cast<double>(cells.size()), strike, dip,
                       unit::span_of(bins, grid.bins, grid.ring, settings.gap).second,
                       unit::span_of(rows, grid.rows, grid.ring_dip, settings.gap).second);
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Slips are multiples of 1/16, so that all sums are exact.
TEST(Plane, RandomPatternsAgreeWithASearch) {
  LSM::Random random(11);
  std::size_t several = 0, holes = 0;
  for (const auto &[bins, rows] :
       std::vector<std::pair<int, int>>{{1, 1}, {1, 6}, {6, 1}, {2, 3}, {9, 7}, {12, 12}})
    for (const double density : {0.02, 0.1})
      for (const int gap : {0, 1})
        for (const std::int64_t memory : {1, 3})
          for (int trial = 0; trial < 12; ++trial) {
            const FaultGrid grid = some_plane(bins, rows, trial % 2, trial / 2 % 2);
            const RuptureSettings settings = some_settings(gap, memory);
            std::vector<Slip> slips;
            for (int n = 1; n <= 12; ++n)
              for (int b = 0; b < bins; ++b)
                for (int k = 0; k < rows; ++k)
                  if (random.uniform() < density)
                    slips.push_back({n, b, k, std::floor(16.0 * random.uniform() - 8.0) / 16.0,
                                     std::floor(1.0 + 8.0 * random.uniform()) / 16.0});
            const std::vector<Numbers> wanted = search(slips, grid, settings);
            if (wanted.size() > 2) ++several;
            for (const bool restarts : {false, true}) {
              std::vector<Numbers> found;
              for (const PlaneRupture &e : find(slips, 12, grid, settings, restarts)) {
                found.emplace_back((e.step_start - 1000) / 4, (e.step_end - 1000) / 4,
                                   e.rupture_area / 3.0, e.moment_strike / 1.5, e.moment_dip / 1.5,
                                   e.rupture_length / 2.0, e.rupture_width / 1.5);
                if (e.rupture_area < e.rupture_length * e.rupture_width) ++holes;
              }
              std::sort(found.begin(), found.end());
              ASSERT_EQ(found, wanted) << bins << " x " << rows << ", trial " << trial;
            }
          }
  EXPECT_GT(several, 50u);
  EXPECT_GT(holes, 50u);
}

}  // namespace
