// SPDX-License-Identifier: GPL-2.0-or-later
/// \file interval_figures.h
/// Inter-event times: their probability densities (paper: Figs. 14, 15), and the generalised gamma
/// parameters of the paper's Table 1 beside ours.
#ifndef LSM_POSTPROC_INTERVAL_FIGURES_H
#define LSM_POSTPROC_INTERVAL_FIGURES_H

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Describes the smallest size of a curve and the reason for it; for earthquakes, the smallest
/// magnitude.
std::string source_of(const IntervalCurve &curve);

/// Probability densities with Poisson errors, and the fitted densities.
/// \param rescaled whether the times are divided by their mean
/// \throws DegenerateData if no curve has a point
Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled);

/// Departure from a steady rate, variation, burstiness and memory, a row per curve.
/// \param date formats a time of earthquakes, given in days since 1970
Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date);

/// Table 1: first the rows printed in the paper, with the digits printed there (it states no unit
/// of theta, no errors and no size threshold), then ours, a row for each fit of each curve.
/// \param rescaled whether our times are divided by their mean
/// \param printed false: only our rows
Table table1(const std::vector<IntervalCurve> &curves, bool rescaled, bool printed = true);

}  // namespace LSM::postproc

#endif
