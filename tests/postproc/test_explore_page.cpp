// SPDX-License-Identifier: GPL-2.0-or-later
#include "explore_page.h"
#include "event_tables.h"
#include "input_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "size_fits.h"
#include "unit_files.h"

namespace {

using namespace LSM;
using namespace LSM::postproc;
using unit::expect_error;

TEST(ExploreSeries, ThinnedKeepsSmallestAndLargest) {
  ExploreSeries series;
  series.info.dt = 0.5;
  series.info.stride = 2;
  series.first_step = 10;
  series.info.step0 = 10;
  for (int i = 0; i < 1001; ++i) series.pe.push_back(std::sin(0.3 * i));
  series.pe[700] = -5.0;
  series.pe[701] = 9.0;
  series.thin(1001);
  EXPECT_EQ(series.pe.size(), 1001U);
  EXPECT_TRUE(series.times.empty());
  series.thin(100);
  EXPECT_LE(series.pe.size(), 100U);
  ASSERT_EQ(series.times.size(), series.pe.size());
  EXPECT_TRUE(std::is_sorted(series.times.begin(), series.times.end()));
  const auto low = std::min_element(series.pe.begin(), series.pe.end());
  EXPECT_EQ(*low, -5.0);
  EXPECT_EQ(series.times[static_cast<std::size_t>(low - series.pe.begin())], 700.0);
  EXPECT_EQ(*std::max_element(series.pe.begin(), series.pe.end()), 9.0);
}

EventTable power_law(std::int64_t n, const std::string &note = "") {
  std::mt19937_64 random(7);
  EventTable table;
  table.info.model = "lsm";
  table.info.parameters = {{"length", "120"}, {"note", note}};
  double time = 0.0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double u = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
    time += -10.0 * std::log((static_cast<double>(random() >> 11) + 0.5) * 0x1p-53);
    EventRow event;
    event.id = i + 1;
    event.size = 1e-5 * std::pow(1e5, u);
    event.t_start = time;
    event.t_end = time + 0.1;
    table.events.push_back(event);
    table.details.push_back(event);
  }
  return table;
}

TEST(Thresholds, GridHasRoundNumbersAndTheUsualOne) {
  EventTable table = power_law(2000);
  table.completeness = 2.7e-4;
  const std::vector<double> grid = threshold_grid(table);
  EXPECT_TRUE(std::is_sorted(grid.begin(), grid.end()));
  for (const double size : {1.3e-5, 1e-4, 2.7e-4, 1.6e-3, 0.05})
    EXPECT_NE(std::find(grid.begin(), grid.end(), size), grid.end()) << size;
  const auto above = [&table](double size) {
    return column_from(table, size, &Event::size).size();
  };
  EXPECT_GE(above(grid.back()), 20u);
  EXPECT_LT(above(1.35 * grid.back()), 20u);
  EXPECT_TRUE(threshold_grid(power_law(19)).empty());
}

TEST(Thresholds, EachIsWhatTheEstimatorsFind) {
  const EventTable table = power_law(600);
  const std::vector<ThresholdResult> results = scan_thresholds(table, {1e-4, 1e-3});
  ASSERT_EQ(results.size(), 2U);
  for (const ThresholdResult &result : results) {
    SizeFitSettings sizes;
    sizes.replicas = 0;
    sizes.threshold = Threshold(result.threshold);
    EXPECT_EQ(result.law.alpha, fit_sizes({table}, sizes)[0].fit.alpha);
    EXPECT_EQ(result.law.lo, result.threshold);
    EXPECT_EQ(result.law.hi, 1000.0 * result.threshold);
    IntervalSettings times;
    times.thresholds = {result.threshold};
    times.replicas = 0;
    const IntervalCurve curve = interval_curves({table}, times)[0];
    EXPECT_EQ(result.intervals.variation, curve.variation);
    ASSERT_EQ(result.intervals.fits.size(), curve.fits.size());
    EXPECT_EQ(result.intervals.fits.front().fit.gamma, curve.fits.front().fit.gamma);
    EXPECT_FALSE(curve.fits.front().fit.degenerate);
    EXPECT_NEAR(curve.burstiness(), (curve.variation - 1) / (curve.variation + 1), 1e-15);
  }
}

class SlipImages : public unit::Files {
 protected:
  template <class... Window>
  static SlipImage image_of(const std::string &path, Window... window) {
    SlipHistoryReader reader = open_history(path, false);
    return slip_image(reader, window...);
  }
};

TEST_F(SlipImages, SlipOfEachPlaceIsKept) {
  SlipHistoryInfo info;
  info.grid.bins = 7;
  info.grid.width = 2.0;
  info.grid.interval = 4;
  info.grid.dt = 0.25;
  info.ruptures.velocity = 0.005;
  info.driving = 0.001;
  info.quiet = 3;
  std::vector<double> slip(7, 0.0);
  {
    SlipHistoryWriter writer;
    writer.create(path("run.slip.bin"), info, 0, 0.0, FaultRow(7).stress);
    for (std::int64_t n = 0; n < 200; ++n) {
      FaultRow row(7);
      for (std::size_t b = 0; b < 7; ++b) {
        const double phase = static_cast<double>(n) / 20.0 - static_cast<double>(b);
        row.slip[b] = phase > 0.0 && phase < 3.0 ? static_cast<float>(0.3 * std::sin(phase)) : 0.0F;
        slip[b] += static_cast<double>(row.slip[b]);
      }
      writer.add(4 * (n + 1), 0.0, row, true);
    }
  }
  const auto slip_of = [](const SlipImage &image) {
    std::vector<double> sums(static_cast<std::size_t>(image.columns), 0.0);
    double before = image.begin;
    for (std::size_t row = 0; row < image.ends.size(); ++row) {
      for (std::size_t c = 0; c < sums.size(); ++c) {
        const int byte = image.cells[row * sums.size() + c];
        const double velocity = image.velocity[static_cast<std::size_t>(std::abs(byte))];
        sums[c] += (byte < 0 ? -velocity : velocity) * 0.001 * (image.ends[row] - before);
      }
      before = image.ends[row];
    }
    return sums;
  };
  const SlipImage whole = image_of(path("run.slip.bin"));
  ASSERT_EQ(whole.columns, 7);
  ASSERT_EQ(whole.ends.size(), 200U);
  for (std::size_t b = 0; b < 7; ++b) EXPECT_NEAR(slip_of(whole)[b], slip[b], 0.01 * slip[b]) << b;
  // Locked places must not seem to move.
  for (std::size_t row = 0; row < 10; ++row)
    for (std::size_t b = 1; b < 7; ++b) EXPECT_EQ(whole.cells[row * 7 + b], 0);

  const SlipImage joined = image_of(path("run.slip.bin"), 0.0, 1e9, 4, 100);
  ASSERT_EQ(joined.columns, 4);
  EXPECT_EQ(joined.bins_per_column, 2);
  EXPECT_LE(joined.cells.size(), 110U);
  EXPECT_DOUBLE_EQ(joined.ends.back(), 200.0);
  EXPECT_NEAR(slip_of(joined)[0], 0.5 * (slip[0] + slip[1]), 0.03 * slip[0]);
  EXPECT_NEAR(slip_of(joined)[3], slip[6], 0.03 * slip[6]);
  expect_error<std::runtime_error>([&] { image_of(path("run.slip.bin"), 1e6); },
                                   "nothing in the window of time");
}

ExploreRun run_of(const std::string &note) {
  ExploreEvents kind;
  kind.table = power_law(100, note);
  kind.table.label = note;
  ExploreRun run;
  run.kinds.push_back(kind);
  return run;
}

TEST(ExplorePage, TextOfCataloguesEndsNoElement) {
  const std::string hostile = "</script><!--<script>alert(1)</script>\xff\"'&";
  const std::string page = explore_html({run_of(hostile)}, {}),
                    plain = explore_html({run_of("x")}, {});
  const auto count = [](const std::string &text, const std::string &what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  for (const char *const mark : {"<script", "</script", "<!--", "<style"})
    EXPECT_EQ(count(page, mark), count(plain, mark)) << mark;
  EXPECT_EQ(page.find("alert(1)<"), std::string::npos);
}

TEST(ExplorePage, FilesEndNoElement) {
  for (const char *const file :
       {"dygraph.min.js", "data.js", "drawing.js", "views.js", "event.js", "table.js",
        "statistics.js", "explore.js", "dygraph.css", "explore.css"})
    for (const char *const end : {"</script", "</style"})
      EXPECT_EQ(page_file(file).find(end), std::string_view::npos) << file;
}

TEST(ExplorePage, NamesNoOtherFile) {
  const std::string page = explore_html({run_of("x")}, {});
  for (const char *const mark : {" src=\"", "href=\"h", "href=\"e", "href=\"d.", "{{title",
                                 "{{data", "@import", "sourceMappingURL"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
  EXPECT_NE(page.find("Permission is hereby granted, free of charge"), std::string::npos);
  EXPECT_NE(page.find("Dan Vanderkam"), std::string::npos);
  EXPECT_THROW(page_file("nothing.js"), std::logic_error);
}

}  // namespace
