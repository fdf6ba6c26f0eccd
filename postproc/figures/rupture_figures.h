// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_figures.h
/// Pictures of the ruptures of a fault (all ours): the fault in space and time from its slip
/// history, and how moment, length, drop of PE and stress drop of the ruptures go together.
#ifndef LSM_POSTPROC_RUPTURE_FIGURES_H
#define LSM_POSTPROC_RUPTURE_FIGURES_H

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "event_table.h"
#include "lsm_catalogue.h"
#include "lsm_slip_history.h"
#include "lsm_slip_sets.h"
#include "plot.h"

namespace LSM::postproc {

/// Ruptures of one catalogue with all their columns.
struct RuptureTable {
  EventTable head;  ///< without events
  std::vector<Event> events;
};

/// Line through logarithms, y = 10^intercept x^slope, by least squares.
struct LogFit {
  std::int64_t n = 0;
  double slope = 0.0, slope_error = 0.0, intercept = 0.0;
  double scatter = 0.0;  ///< root mean square distance in decades
  /// Of y / x, if y were proportional to x: 10^mean of the logarithms, and its scatter in decades.
  double ratio = 0.0, ratio_scatter = 0.0;
};
/// Both of each pair have to be positive. \throws std::runtime_error for fewer than three pairs, or
/// of one x only
LogFit fit_logarithms(const std::vector<std::pair<double, double>> &points);

/// Whether the ruptures at the same time as each one (which a drop of the total PE holds as well)
/// have less than a tenth of its moment together.
std::vector<bool> slips_by_itself(const std::vector<Event> &events);

Figure moment_length_figure(const std::vector<RuptureTable> &tables);
Figure moment_pe_figure(const std::vector<RuptureTable> &tables);
Figure stress_drop_figure(const std::vector<RuptureTable> &tables);

/// Where and when one rupture slipped: first and last step of each bin.
struct Outline : SlipSet {
  std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> bins;
  double slip = 0.0;
  void absorb(const Outline &later);
};

/// What a history says of a window of time.
struct HistoryWindow {
  SlipHistoryInfo info;
  std::vector<SlipRecord> records;  ///< those that overlap with the window
  /// of the ruptures within, the largest first; steps, not intervals
  std::vector<Outline> outlines;
  double from = 0.0, to = 0.0;  ///< ends of the window, within the history (model time)
};
/// \throws FileError; std::runtime_error if there is nothing in the window
HistoryWindow load_history(const std::string &path, bool lenient, double from, double to);

/// Slip velocity in space and time with the ruptures outlined.
/// \param outlines path of a second table that the script reads
Figure space_time_figure(const HistoryWindow &window, Table &outlines);
/// Lines of the slip along the fault since the beginning of the window, one each `locked` time
/// units, and one each `slipping` while anything slips.
Figure slip_lines_figure(const HistoryWindow &window, double locked, double slipping);
/// One rupture: slip velocity around its first place, with two wave speeds as slopes, and its slip.
Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines);

}  // namespace LSM::postproc

#endif
