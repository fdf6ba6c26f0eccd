// SPDX-License-Identifier: GPL-2.0-or-later
/// \file interval_figures.h
/// Inter-event times: their probability densities (paper: Figs. 14, 15), and the parameters of
/// generalised gamma densities (Table 1).
#ifndef LSM_POSTPROC_INTERVAL_FIGURES_H
#define LSM_POSTPROC_INTERVAL_FIGURES_H

#include <cmath>
#include <cstdint>
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
Table clustering_table(const std::vector<IntervalCurve> &curves);

/// The fitted densities, a row for each fit of each curve.
/// \param rescaled whether the times are divided by their mean
Table interval_fit_table(const std::vector<IntervalCurve> &curves, bool rescaled);

}  // namespace LSM::postproc

#endif
