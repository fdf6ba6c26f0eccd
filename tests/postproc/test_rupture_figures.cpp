// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "crack.h"
#include "input_file.h"
#include "rupture_figures.h"
#include "unit_files.h"

namespace {

using namespace LSM;
using namespace LSM::postproc;
using unit::contains;
using unit::message_of;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Ten bins of width 2 and intervals of 4 steps of 0.25. Bins slip above 5 times the driving
/// velocity of 0.001.
class RuptureHistory : public unit::Files {
 protected:
  std::string file() const { return path("slip.bin"); }

  /// One line per interval, one character per bin; a digit is the slip of the bin in hundredths.
  void write(const std::vector<std::string> &pattern) const {
    SlipHistoryInfo info;
    info.grid.bins = 10;
    info.grid.width = 2.0;
    info.grid.interval = 4;
    info.grid.time0 = 50.0;
    info.grid.dt = 0.25;
    info.ruptures.velocity = 0.005;
    info.driving = 0.001;
    info.quiet = 3;
    SlipHistoryWriter writer;
    writer.create(file(), info, 0, 0.0, FaultRow(10).stress);
    for (std::size_t n = 0; n < pattern.size(); ++n) {
      FaultRow row(10);
      bool slips = false;
      for (std::size_t b = 0; b < 10; ++b) {
        if (pattern[n][b] == '.') continue;
        row.slip[b] = 0.01F * static_cast<float>(pattern[n][b] - '0');
        slips = true;
      }
      writer.add(4 * static_cast<std::int64_t>(n + 1), 0.0, row, slips);
    }
  }

  HistoryWindow window_of(double from, double to) const {
    SlipHistoryReader reader = open_history(file(), false);
    std::vector<SlipRecord> records;
    for (SlipRecord record; reader.next(record);) records.push_back(record);
    return with_path(file(), [&] { return history_window(reader.info(), records, from, to); });
  }
};

/// Rows of a table by field.
std::vector<std::vector<std::string>> rows_of(const Table &table) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(table.csv());
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream split(line);
    for (std::string field; std::getline(split, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST_F(RuptureHistory, OutlinesAreThoseOfTheSlippingBins) {
  write({"..........",  //
         "1........2",  //
         ".........2",  //
         "....3.....",  //
         "..........", ".........."});
  const HistoryWindow window = window_of(-infinity, infinity);
  EXPECT_EQ(window.from, 50.0);
  EXPECT_EQ(window.to, 54.0);  // two quiet intervals at the end are in no record
  ASSERT_EQ(window.outlines.size(), 2U);
  const Outline &seam = window.outlines[0], &other = window.outlines[1];
  EXPECT_NEAR(seam.slip, 0.05, 1e-7);
  EXPECT_EQ(seam.begin, 9);
  EXPECT_EQ(seam.length, 2);
  EXPECT_EQ(seam.step_start, 4);
  EXPECT_EQ(seam.step_end, 12);
  EXPECT_EQ(seam.bins.at(9), std::make_pair(std::int64_t{4}, std::int64_t{12}));
  EXPECT_EQ(seam.bins.at(0), std::make_pair(std::int64_t{4}, std::int64_t{8}));
  EXPECT_EQ(other.begin, 4);
  EXPECT_EQ(other.step_start, 12);

  EXPECT_EQ(window_of(53.5, infinity).outlines.size(), 1U);
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { window_of(60.0, 70.0); }),
                       "slip.bin: nothing in the window of time"));
}

TEST_F(RuptureHistory, SpaceAndTime) {
  write({"..........", "1........2", ".........2", "....3.....", "..........", ".........."});
  const HistoryWindow window = window_of(-infinity, infinity);
  Table outlines({"curve", "x", "y"});
  const Figure figure = space_time_figure(window, outlines);
  const auto rows = rows_of(figure.table);
  ASSERT_EQ(rows.size(), 1U + 4U * 10U);
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const double x = std::stod(rows[n][0]), t = std::stod(rows[n][1]), v = std::stod(rows[n][2]);
    double slip = 0.0;
    if (t == 51.5) slip = x == 1.0 ? 0.01 : x == 19.0 ? 0.02 : 0.0;
    if (t == 52.5) slip = x == 19.0 ? 0.02 : 0.0;
    if (t == 53.5) slip = x == 9.0 ? 0.03 : 0.0;
    EXPECT_NEAR(v, slip > 0.0 ? std::log10(slip / 0.001) : 0.0, 1e-6) << x << " " << t;
  }
  // The outline across the seam is split into two closed lines of 5 points and a row that ends
  // them.
  const auto lines = rows_of(outlines);
  ASSERT_EQ(lines.size(), 1U + 6U + 6U + 6U);
  EXPECT_EQ(lines[1], (std::vector<std::string>{"1", "18", "51"}));
  EXPECT_EQ(lines[3], (std::vector<std::string>{"1", "20", "53"}));
  EXPECT_EQ(lines[6], (std::vector<std::string>{"NaN", "NaN", "NaN"}));
  EXPECT_EQ(lines[7], (std::vector<std::string>{"1", "0", "51"}));
  EXPECT_EQ(lines[9], (std::vector<std::string>{"1", "2", "52"}));
  EXPECT_EQ(lines[13][0], "2");
}

TEST_F(RuptureHistory, LinesOfSlip) {
  write({"..........", "1........2", ".........2", "....3.....", "..........", "..........",
         ".........."});
  const HistoryWindow window = window_of(-infinity, infinity);
  const auto rows = rows_of(slip_lines_figure(window, 2.0, 1.0).table);
  // The fault is locked at the times 50 (the first record) and 57, and slips at 52, 53, 54. At 51
  // the next line is not due yet.
  std::vector<std::pair<std::string, double>> lines;  // time, sum of the slip
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n][0] == "NaN") continue;
    if (lines.empty() || lines.back().first != rows[n][1]) lines.emplace_back(rows[n][1], 0.0);
    lines.back().second += std::stod(rows[n][4]);
    EXPECT_EQ(rows[n][2], rows[n][1] == "50" || rows[n][1] == "57" ? "0" : "1");
  }
  ASSERT_EQ(lines.size(), 5U);
  const std::vector<std::pair<std::string, double>> expected = {
      {"50", 0.0}, {"52", 0.03}, {"53", 0.05}, {"54", 0.08}, {"57", 0.08}};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(lines[k].first, expected[k].first);
    EXPECT_NEAR(lines[k].second, expected[k].second, 1e-7);
  }
}

TEST_F(RuptureHistory, DetailIsCentredOnTheFirstPlace) {
  write({"..........", "1........2", ".........2", "....3.....", "..........", ".........."});
  const HistoryWindow window = window_of(-infinity, infinity);
  Event event;
  event.id = 1;
  event.step_start = 4;
  event.step_end = 12;
  event.t_start = 51.0;
  event.t_end = 53.0;
  event.x_hypocentre = 19.0;
  event.rupture_length = 4.0;
  Table lines({"curve", "x", "y"});
  const Figure figure = rupture_detail_figure(window, event, 2.0, 1.0, lines);
  double seen = 0.0;
  for (const auto &row : rows_of(figure.table))
    if (row[0] == "0" && row[1] == "0.5") seen = std::stod(row[2]);
  EXPECT_NEAR(seen, std::log10(20.0), 1e-6);
  int outline = 0;
  double slip = 0.0;
  bool p = false, s = false;
  for (const auto &row : rows_of(lines)) {
    if (row[0] == "1") {
      ++outline;
      EXPECT_LE(std::fabs(std::stod(row[1]) - 1.0), 2.0);  // from -1 to 3 around the first place
    }
    if (row[0] == "2" && std::stod(row[1]) > 0.0) p = std::stod(row[2]) * 2.0 == std::stod(row[1]);
    if (row[0] == "3" && std::stod(row[1]) > 0.0) s = row[1] == row[2];
    if (row[0] == "4" && row[1] == "0") slip = std::stod(row[2]);
  }
  EXPECT_EQ(outline, 9);  // two bins in one closed line
  EXPECT_TRUE(p);
  EXPECT_TRUE(s);
  EXPECT_NEAR(slip, 0.04, 1e-7);
  // gnuplot accepts the script.
  lines.write(path("figure-lines.csv"));
  EXPECT_TRUE(contains(figure.script, "P-wave, speed 2"));
}

TEST(LogFit, LineAndProportion) {
  std::vector<std::pair<double, double>> points;
  for (int n = 1; n <= 20; ++n)
    points.emplace_back(n, 3.0 * n * n * (n % 2 ? 2.0 : 0.5));  // up and down by log10(2)
  const LogFit fit = fit_logarithms(points);
  EXPECT_EQ(fit.n, 20);
  EXPECT_NEAR(fit.slope, 2.0, 0.15);
  EXPECT_GT(fit.slope_error, 0.01);
  EXPECT_NEAR(fit.scatter, std::log10(2.0), 0.02);
  for (auto &[x, y] : points) y = 0.25 * x;
  const LogFit exact = fit_logarithms(points);
  EXPECT_NEAR(exact.slope, 1.0, 1e-12);
  EXPECT_NEAR(exact.ratio, 0.25, 1e-12);
  EXPECT_NEAR(exact.scatter, 0.0, 1e-9);
  EXPECT_NEAR(exact.ratio_scatter, 0.0, 1e-9);
  points.resize(2);
  EXPECT_THROW(fit_logarithms(points), std::runtime_error);
  EXPECT_THROW(fit_logarithms({{2.0, 1.0}, {2.0, 3.0}, {2.0, 5.0}}), std::runtime_error);
}

TEST(AloneInTime, CountsWhatOverlaps) {
  std::vector<Event> events(5);
  const double rows[5][3] = {
      {0, 10, 1.0}, {5, 6, 0.05}, {9.5, 20, 0.04}, {20, 30, 5.0}, {0, 4, -0.2}};
  for (std::size_t k = 0; k < 5; ++k) {
    events[k].t_start = rows[k][0];
    events[k].t_end = rows[k][1];
    events[k].slip_moment = rows[k][2];
  }
  EXPECT_EQ(slips_by_itself(events), (std::vector<bool>{false, false, false, true, false}));
  events[4].slip_moment = 0.005;
  EXPECT_EQ(slips_by_itself(events), (std::vector<bool>{true, false, false, true, false}));
}

// ---- maps of a plane

class RuptureMaps : public unit::Files {
 protected:
  std::string file() const { return path("plane.bin"); }
  SlipMap map_of(const unit::Crack &crack) const {
    const std::vector<Event> events = crack.record(file());
    EXPECT_EQ(events.size(), 1U);
    SlipHistoryReader reader = open_history(file(), false);
    return slip_map(reader, events.at(0), crack.settings().velocity);
  }
};

TEST_F(RuptureMaps, OfAnEllipticCrack) {
  double late = 0.0;
  for (const double cell : {0.5, 0.25}) {
    const unit::Crack crack(cell);
    const SlipMap map = map_of(crack);
    EXPECT_EQ(map.x_first, crack.x);
    EXPECT_EQ(map.z_first, crack.z);
    EXPECT_NEAR(map.strike.length(), 24.0, 2.0 * cell);
    EXPECT_NEAR(map.dip.length(), 12.0, 2.0 * cell);
    double worst = 0.0, slip = 0.0;
    int came = 0;
    for (std::size_t k = 0; k < map.time.size(); ++k) {
      const double reached =
          std::hypot((map.x(k) - crack.x) / crack.speed, (map.z(k) - crack.z) / crack.speed_dip);
      ASSERT_EQ(std::isnan(map.time[k]), !(reached < crack.until)) << reached;
      if (std::isnan(map.time[k])) continue;
      ++came;
      slip += map.slip[k];
      worst = std::max(worst, std::fabs(map.time[k] - reached));
      EXPECT_NEAR(map.slip[k],
                  crack.rate * std::sqrt(crack.until * crack.until - reached * reached), 1e-5);
      EXPECT_GT(map.rate[k], 0.05);
    }
    // The slip rate jumps within an interval; the middle of the one before is 1.5 before its end.
    EXPECT_LT(worst, 1.5 * crack.grid.duration());
    EXPECT_NEAR(came * crack.grid.area(), crack.area(), 0.04 * cell * crack.area());
    if (late > 0.0) {
      EXPECT_LT(worst, 0.6 * late);
    }
    late = worst;

    // The moment rate adds up to the moment of the crack until then, and in the end.
    double moment = 0.0;
    for (const MomentRate &one : map.moment) {
      moment += one.rate.size() * crack.grid.duration();
      const double end = std::min(one.time + 0.5 * crack.grid.duration(), crack.until);
      EXPECT_NEAR(moment, crack.moment(end), 0.02 * cell * crack.moment());
      EXPECT_NEAR(one.rate.dip, -0.75 * one.rate.strike, 1e-4 * one.rate.size() + 1e-9);
    }
    EXPECT_NEAR(moment, crack.modulus * slip * crack.grid.area(), 1e-4 * moment);

    // Contours are ellipses about the hypocentre.
    std::size_t pieces = 0;
    for (const ContourPiece &piece : contours(map, map.time, 1.5)) {
      ++pieces;
      for (std::size_t end = 0; end < 2; ++end)
        EXPECT_NEAR(std::hypot((piece.x[end] - crack.x) / crack.speed,
                               (piece.z[end] - crack.z) / crack.speed_dip),
                    piece.level, 0.5 * cell);
    }
    EXPECT_GT(pieces, 100U);
  }
}

TEST_F(RuptureMaps, ContoursOfAPlaneAreStraightAndEndAtGaps) {
  SlipMap map{{5, 0.0, 1.0, false}, {4, 0.0, 1.0, false}, 0.0, 0.0, {}, {}, {}, {}};
  std::vector<double> values;
  for (std::size_t k = 0; k < 20; ++k) values.push_back(map.x(k) + 2.0 * map.z(k));
  double length = 0.0;
  for (const ContourPiece &piece : contours(map, values, 2.0)) {
    length += std::hypot(piece.x[1] - piece.x[0], piece.z[1] - piece.z[0]);
    for (std::size_t end = 0; end < 2; ++end)
      EXPECT_NEAR(piece.x[end] + 2.0 * piece.z[end], piece.level, 1e-12);
  }
  // x + 2 z = 2, 4, 6, 8, 10 within 0.5 to 4.5 and 0.5 to 3.5: differences of x of 0.5, 2.5,
  // 4, 3.5, 1.5.
  EXPECT_NEAR(length, 12.0 * std::sqrt(1.25), 1e-12);
  values.assign(20, 7.0);
  EXPECT_TRUE(contours(map, values, 1.0).empty());
  values[7] = std::numeric_limits<double>::quiet_NaN();
  values[0] = 3.0;
  for (const ContourPiece &piece : contours(map, values, 2.0)) EXPECT_LT(piece.x[0], 2.0);
}

TEST_F(RuptureMaps, AcrossTheSeam) {
  unit::Crack crack(0.5);
  crack.grid.ring = true;
  crack.seam = crack.grid.length();
  for (const int bin : {40, 79, 0}) {
    crack.x = crack.grid.strike().centre(bin);
    const SlipMap map = map_of(crack);
    EXPECT_NEAR(map.strike.length(), 24.0, 1.0);
    // The rectangle begins within the period, and may continue beyond its end.
    EXPECT_DOUBLE_EQ(map.x_first, crack.x + (bin == 0 ? crack.seam : 0.0));
    EXPECT_NEAR(map.strike.begin + 0.5 * map.strike.length(), map.x_first, 1e-9);
    for (std::size_t k = 0; k < map.time.size(); ++k) {
      const double reached = std::hypot((map.x(k) - map.x_first) / crack.speed,
                                        (map.z(k) - crack.z) / crack.speed_dip);
      EXPECT_EQ(std::isnan(map.time[k]), !(reached < crack.until)) << reached;
    }
  }
}

}  // namespace
