// SPDX-License-Identifier: GPL-2.0-or-later
/// \file clustering_tables.h
/// Steadiness of the rate and clustering of inter-event times, as text and as a table.
#ifndef LSM_POSTPROC_CLUSTERING_TABLES_H
#define LSM_POSTPROC_CLUSTERING_TABLES_H

#include <functional>
#include <string>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Text of a time of earthquakes, which is in days since 1970.
using DateText = std::function<std::string(double)>;

/// Curves without clustering (too few times, or not asked for) are left out.
std::string clustering_text(const std::vector<IntervalCurve> &curves, const DateText &date);

/// For BASE.clustering.csv.
Table clustering_csv(const std::vector<IntervalCurve> &curves);

}  // namespace LSM::postproc

#endif
