// SPDX-License-Identifier: GPL-2.0-or-later
/// \file report_page.h
/// One HTML page about a set of catalogues: parameters, counts, figures, fits, Table 1.
#ifndef LSM_POSTPROC_REPORT_PAGE_H
#define LSM_POSTPROC_REPORT_PAGE_H

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "event_table.h"
#include "results.h"
#include "finite_size.h"
#include "series_figures.h"

namespace LSM::postproc {

/// A section of a single statistic for each model.
struct ReportSection {
  std::string heading;
  std::function<Results(const std::vector<EventTable> &)> find;
};

struct ReportSettings {
  std::string title = "Event statistics of the fault and the block-slider";
  Threshold threshold;           ///< smallest size (model energy)
  int replicas = 100;            ///< of the Monte Carlo p-values of sizes; 0: none
  int interval_replicas = 1000;  ///< the same of inter-event times
  Resampling bootstrap;          ///< of the characteristic sizes, with seed below
  std::uint64_t seed = 1;
  std::vector<ReportSection> sections;  ///< after those that every report has
};

/// The whole page. It needs no other file and no network; pictures are SVG within it. What cannot
/// be drawn or fitted says why in its place. \throws PlotError if gnuplot cannot draw;
/// std::invalid_argument for impossible settings
std::string report_html(const std::vector<EventTable> &tables, const ReportSettings &settings,
                        const std::vector<SeriesRegime> &series = {});

}  // namespace LSM::postproc

#endif
