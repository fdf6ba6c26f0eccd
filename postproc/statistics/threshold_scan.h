// SPDX-License-Identifier: GPL-2.0-or-later
/// \file threshold_scan.h
/// Exponents and inter-event times of one catalogue for many smallest sizes † (the paper has one).
/// Each entry equals the result of `postproc fit` and `postproc intervals` for that threshold.
#ifndef LSM_POSTPROC_THRESHOLD_SCAN_H
#define LSM_POSTPROC_THRESHOLD_SCAN_H

#include <vector>

#include "event_table.h"
#include "intervals.h"
#include "power_law.h"

namespace LSM::postproc {

/// Results for one catalogue above one threshold.
struct ThresholdResult {
  double threshold = 0.0;  ///< smallest size (model energy)
  PowerLawFit law;         ///< on paper_range()
  /// by least squares and maximum likelihood, delta = 1 and free; no p-values
  IntervalCurve intervals;
};

/// Ten thresholds per decade with two digits (1, 1.3, 1.6, 2, ...), so that they are easy to type,
/// from the smallest event of the table to the largest size that at least 20 events reach, and the
/// threshold that the commands use by default.
/// \return thresholds in ascending order; none if the table has fewer than 20 events
std::vector<double> threshold_grid(const EventTable &table);

/// Analyses a catalogue above each threshold.
/// \throws std::invalid_argument for impossible thresholds
std::vector<ThresholdResult> scan_thresholds(const EventTable &table,
                                             const std::vector<double> &thresholds);

}  // namespace LSM::postproc

#endif
