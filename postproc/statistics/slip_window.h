// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_window.h
/// The part of a slip history in a window of time, with the outlines of the ruptures in it †.
#ifndef LSM_POSTPROC_SLIP_WINDOW_H
#define LSM_POSTPROC_SLIP_WINDOW_H

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "files/slip_history.h"
#include "events/slip_sets.h"

namespace LSM::postproc {

/// Where and when one rupture slipped: first and last step of each bin.
struct Outline : SlipSet {
  std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> bins;
  double slip = 0.0;
  void absorb(const Outline &later);
};

/// The part of a history in a window of time.
struct HistoryWindow {
  SlipHistoryInfo info;
  std::vector<SlipRecord> records;  ///< those that overlap with the window
  /// of the ruptures within, the largest first; steps, not intervals
  std::vector<Outline> outlines;
  double from = 0.0, to = 0.0;  ///< ends of the window, within the history (model time)
};
/// \param records of a history, in their order
/// \throws std::runtime_error if there is nothing in the window
HistoryWindow history_window(const SlipHistoryInfo &info, const std::vector<SlipRecord> &records,
                             double from, double to);

/// The largest slip velocity over the driving one in each pixel of a picture.
struct VelocityImage {
  /// As many rows as there are intervals in the window, and as many columns as bins, up to these
  /// and 1000.
  VelocityImage(const HistoryWindow &window, std::int64_t most_rows);
  /// \param shift bins by which the picture is shifted along the fault
  double at(std::int64_t row, std::int64_t column, std::int64_t shift) const;

  std::int64_t bins, rows, columns;
  double row_height, column_width;  ///< height: model time
  std::vector<double> values;       ///< row by row
};

/// The outline of a rupture as closed lines, split where a picture ends: places, in bins from its
/// left end, and times. \param shift bins by which the picture is shifted along the fault
using ClosedLine = std::vector<std::pair<double, double>>;
std::vector<ClosedLine> closed_lines(const FaultGrid &grid, const Outline &outline,
                                     std::int64_t shift);

/// Slip of each bin from the beginning of the window to a time.
struct SlipLine {
  double time;
  bool slipping;  ///< any bin
  std::vector<double> slip;
};
/// One every `locked` time units, and one every `slipping` while anything slips.
std::vector<SlipLine> slip_lines(const HistoryWindow &window, double locked, double slipping);

/// Slip of each bin from one step to another.
std::vector<double> slip_between(const HistoryWindow &window, std::int64_t begin, std::int64_t end);

}  // namespace LSM::postproc

#endif
