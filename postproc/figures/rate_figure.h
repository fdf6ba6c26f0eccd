// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rate_figure.h
/// Rates of events and of what they release over time †.
#ifndef LSM_POSTPROC_RATE_FIGURE_H
#define LSM_POSTPROC_RATE_FIGURE_H

#include <string>
#include <vector>

#include "plot.h"
#include "rates.h"

namespace LSM::postproc {

/// One catalogue.
struct ReleaseCurve {
  std::string label, model;
  std::vector<ReleaseBin> bins;
};

/// Names with units of what is drawn.
struct ReleaseNames {
  std::string time, events, released;
};

/// Both rates as steps, one panel each. \throws std::runtime_error if no curve has an event
Figure release_figure(const std::vector<ReleaseCurve> &curves, const ReleaseNames &names);

}  // namespace LSM::postproc

#endif
