// SPDX-License-Identifier: GPL-2.0-or-later
/// \file report_page.h
/// An HTML page about a set of catalogues: parameters, counts, figures, fits and Table 1.
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

/// A section about one statistic, which the page has for each model.
struct ReportSection {
  std::string heading;
  std::function<Results(const std::vector<EventTable> &)> find;
};

/// Settings of the page.
struct ReportSettings {
  std::string title = "Event statistics of the fault and the block-slider";
  Threshold threshold;           ///< smallest size (model energy)
  int replicas = 100;            ///< of the Monte Carlo p-values of size fits; 0: none
  int interval_replicas = 1000;  ///< likewise, of inter-event times
  Resampling bootstrap;          ///< of the characteristic sizes; the seed is `seed`
  std::uint64_t seed = 1;
  std::vector<ReportSection> sections;  ///< follow those that every report has
};

/// Returns the whole page, which needs no other file and no network, as its figures are inline SVG.
/// Where something cannot be drawn or fitted, the page states the reason.
/// \throws PlotError if gnuplot cannot draw
/// \throws std::invalid_argument for impossible settings
std::string report_html(const std::vector<EventTable> &tables, const ReportSettings &settings,
                        const std::vector<SeriesRegime> &series = {});

}  // namespace LSM::postproc

#endif
