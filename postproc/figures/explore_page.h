// SPDX-License-Identifier: GPL-2.0-or-later
/// \file explore_page.h
/// One page on which a person explores runs: PE with its events, each event, its slip, and the
/// statistics against a threshold that is dragged. The page itself is in figures/explore.
#ifndef LSM_POSTPROC_EXPLORE_PAGE_H
#define LSM_POSTPROC_EXPLORE_PAGE_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "event_table.h"
#include "files/catalogue.h"
#include "files/pe_series.h"
#include "slip_image.h"
#include "threshold_scan.h"

namespace LSM::postproc {

/// PE of a run.
struct ExploreSeries {
  std::string path;
  PeSeriesInfo info;
  std::int64_t samples = 0;     ///< in the file, within the times asked for
  std::int64_t first_step = 0;  ///< of the first of them
  std::vector<double> pe;
  std::vector<double> times;  ///< of each; empty: they are one stride apart

  /// Joins neighbours until there are at most `most`: of each group the smallest and the largest
  /// stay, in their order.
  void thin(std::int64_t most);
};

/// Events of one kind.
struct ExploreEvents {
  EventTable table;  ///< `details` are those that the page lists
  std::vector<ThresholdResult> thresholds;
};

struct ExploreRun {
  std::vector<ExploreEvents> kinds;  ///< at least one; drops of PE before ruptures
  std::optional<ExploreSeries> series;
  std::optional<SlipImage> history;
  std::string history_path;
};

struct ExploreSettings {
  std::string title;                      ///< empty: the label of the run, or how many there are
  double p_speed = 2.12, s_speed = 1.22;  ///< of waves, beside the slip
  std::string program;                    ///< what made the page
};

/// The whole page. It needs no other file and no network.
std::string explore_html(const std::vector<ExploreRun> &runs, const ExploreSettings &settings);

}  // namespace LSM::postproc

#endif
