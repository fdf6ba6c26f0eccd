// SPDX-License-Identifier: GPL-2.0-or-later
/// \file explore_page.h
/// An HTML page for exploring runs interactively: PE with its events, each event, its slip, and the
/// statistics against a threshold that can be dragged. Its HTML and JavaScript are in
/// output/explore.
#ifndef LSM_POSTPROC_EXPLORE_PAGE_H
#define LSM_POSTPROC_EXPLORE_PAGE_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "event_table.h"
#include "files/catalogue.h"
#include "files/pe_series.h"
#include "slip_image.h"
#include "threshold_scan.h"

namespace LSM::postproc {

/// The PE series of a run.
struct ExploreSeries {
  std::string path;
  PeSeriesInfo info;
  std::int64_t samples = 0;     ///< in the file, within the requested times
  std::int64_t first_step = 0;  ///< of the first of these samples
  std::vector<double> pe;
  std::vector<double> times;  ///< of the values; empty: one stride apart

  /// Reduces the series to at most `most` values. Neighbouring values are grouped, and the smallest
  /// and the largest of each group are kept in their order, so that short drops stay visible.
  void thin(std::int64_t most);
};

/// Events of one kind.
struct ExploreEvents {
  EventTable table;  ///< its `details` are the events listed on the page
  std::vector<ThresholdResult> thresholds;
};

struct ExploreRun {
  std::vector<ExploreEvents> kinds;  ///< at least one; drops of PE come before ruptures
  std::optional<ExploreSeries> series;
  std::optional<SlipImage> history;
  std::string history_path;
};

struct ExploreSettings {
  std::string title;                    ///< empty: label of the run, or number of runs
  double p_speed = 0.0, s_speed = 0.0;  ///< wave speeds, drawn over the slip
  std::string program;                  ///< name and version of the program
};

/// Returns a file that was compiled into the program: of output/explore or of the library that it
/// uses.
/// \throws std::logic_error if there is no such file
std::string_view page_file(std::string_view name);

/// How a page begins. Files that begin otherwise are not replaced.
std::string_view head_of_page();

/// Returns the whole page, which needs no other file and no network.
/// \param runs at least one
std::string explore_html(const std::vector<ExploreRun> &runs, const ExploreSettings &settings);

}  // namespace LSM::postproc

#endif
