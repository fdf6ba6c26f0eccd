// SPDX-License-Identifier: GPL-2.0-or-later
/// \file report.h
/// One HTML page about a set of catalogues: parameters, counts, figures, fits, Table 1.
#ifndef LSM_POSTPROC_REPORT_H
#define LSM_POSTPROC_REPORT_H

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "event_table.h"
#include "findings.h"
#include "finite_size.h"
#include "regime.h"

namespace LSM::postproc {

/// A section of a single statistic for each model.
struct ReportSection {
  std::string heading;
  std::function<Findings(const std::vector<EventTable> &)> find;
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

/// Whether one PE series sticks and slips.
struct SeriesRegime {
  std::string path, model;
  double length =
      std::numeric_limits<double>::quiet_NaN();  ///< or number of blocks; NaN: not given
  double first = 0.0, last = 0.0;                ///< times of the samples used
  std::optional<Regime> regime;
  std::string why;  ///< reason if there is none
};

/// The whole page. It needs no other file and no network; pictures are SVG within it. What cannot
/// be drawn or fitted says why in its place. \throws PlotError if gnuplot cannot draw;
/// std::invalid_argument for impossible settings
std::string report_html(const std::vector<EventTable> &tables, const ReportSettings &settings,
                        const std::vector<SeriesRegime> &series = {});

/// Text with the characters that HTML reserves replaced.
std::string html_escape(std::string_view text);

/// gnuplot's SVG as an element of a page: no prologue, identifiers that begin with prefix (those of
/// several pictures would clash), background of the page, title as its name for screen readers.
std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title);

}  // namespace LSM::postproc

#endif
