// SPDX-License-Identifier: GPL-2.0-or-later
/// \file threshold_scan.h
/// Exponents and inter-event times of one catalogue over many smallest sizes † (the paper has
/// one). Each entry is what `postproc fit` and `postproc intervals` find for that threshold.
#ifndef LSM_POSTPROC_THRESHOLD_SCAN_H
#define LSM_POSTPROC_THRESHOLD_SCAN_H

#include <vector>

#include "event_table.h"
#include "intervals.h"
#include "power_law.h"

namespace LSM::postproc {

/// One catalogue above one threshold.
struct ThresholdResult {
  double threshold = 0.0;   ///< smallest size (model energy)
  PowerLawFit law;          ///< on paper_range()
  IntervalCurve intervals;  ///< least squares and maximum likelihood, delta 1 and free, no p-values
};

/// Ten sizes a decade with two digits (1, 1.3, 1.6, 2, ...), so that one can type them, from the
/// smallest event of the table to the largest size with at least 20 events, and the threshold
/// that the commands use where none is given. In ascending order; empty if the table has fewer
/// events than that.
std::vector<double> threshold_grid(const EventTable &table);

/// \throws std::invalid_argument for impossible thresholds
std::vector<ThresholdResult> scan_thresholds(const EventTable &table,
                                             const std::vector<double> &thresholds);

}  // namespace LSM::postproc

#endif
