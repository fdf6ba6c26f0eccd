// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_window.h
/// The part of a slip history in a window of time, with the outlines of the ruptures in it (ours).
#ifndef LSM_POSTPROC_SLIP_WINDOW_H
#define LSM_POSTPROC_SLIP_WINDOW_H

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "lsm_slip_history.h"
#include "lsm_slip_sets.h"

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

}  // namespace LSM::postproc

#endif
