// SPDX-License-Identifier: GPL-2.0-or-later
/// \file interval_figure.h
/// Densities of inter-event times (paper: Figs. 14, 15).
#ifndef LSM_POSTPROC_INTERVAL_FIGURE_H
#define LSM_POSTPROC_INTERVAL_FIGURE_H

#include <string>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Smallest size and where it comes from; of earthquakes the smallest magnitude.
std::string source_of(const IntervalCurve &curve);

/// Densities with Poisson errors and the fitted curves. \param rescaled times are over their mean
/// \throws std::runtime_error if no curve has a point
Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled, int width = 900);

}  // namespace LSM::postproc

#endif
