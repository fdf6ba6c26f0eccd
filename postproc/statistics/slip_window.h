// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_window.h
/// Part of a slip history within a window of time, with the outlines of the ruptures in it †.
#ifndef LSM_POSTPROC_SLIP_WINDOW_H
#define LSM_POSTPROC_SLIP_WINDOW_H

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "files/slip_history.h"
#include "events/slip_sets.h"

namespace LSM::postproc {

/// Where and when one rupture slipped: the first and the last step of each bin.
struct Outline : SlipSet {
  std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> bins;
  double slip = 0.0;
  /// Merges a later outline into this one.
  void absorb(const Outline &later);
};

/// Part of a history within a window of time.
struct HistoryWindow {
  SlipHistoryInfo info;
  std::vector<SlipRecord> records;  ///< records that overlap with the window
  /// Outlines of the ruptures in the window, the largest first; times are steps, not intervals.
  std::vector<Outline> outlines;
  double from = 0.0, to = 0.0;  ///< ends of the window, cut to the history (model time)
};
/// Selects the records in a window and outlines the ruptures.
/// \param records records of a history in order of time
/// \param from, to model times
/// \throws std::runtime_error if the window contains no records
HistoryWindow history_window(const SlipHistoryInfo &info, const std::vector<SlipRecord> &records,
                             double from, double to);

/// Pixels with the largest slip velocity in each, over the driving velocity.
struct VelocityImage {
  /// The image has one row per interval of the window, but at most `most_rows`, and one column per
  /// bin, but at most 1000.
  VelocityImage(const HistoryWindow &window, std::int64_t most_rows);
  /// Value of a pixel.
  /// \param shift number of bins by which the picture is shifted along the fault
  double at(std::int64_t row, std::int64_t column, std::int64_t shift) const;

  std::int64_t bins, rows, columns;
  double row_height, column_width;  ///< row_height in model time
  std::vector<double> values;       ///< row by row
};

/// A closed line of (place, time) points: places in bins from the left end of a picture, model
/// times.
using ClosedLine = std::vector<std::pair<double, double>>;
/// The outline of a rupture as closed lines, split where it continues beyond an end of the picture.
/// \param shift number of bins by which the picture is shifted along the fault
std::vector<ClosedLine> closed_lines(const FaultGrid &grid, const Outline &outline,
                                     std::int64_t shift);

/// Slip of each bin from the beginning of the window up to a time.
struct SlipLine {
  double time;
  bool slipping;  ///< whether any bin slips
  std::vector<double> slip;
};
/// Profiles of slip every `locked` time units, and every `slipping` while anything slips.
std::vector<SlipLine> slip_lines(const HistoryWindow &window, double locked, double slipping);

/// Slip of each bin between two steps.
std::vector<double> slip_between(const HistoryWindow &window, std::int64_t begin, std::int64_t end);

}  // namespace LSM::postproc

#endif
