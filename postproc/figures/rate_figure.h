// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rate_figure.h
/// Rates of events and of the energy or moment that they release, over time †.
#ifndef LSM_POSTPROC_RATE_FIGURE_H
#define LSM_POSTPROC_RATE_FIGURE_H

#include <string>
#include <vector>

#include "plot.h"
#include "rates.h"

namespace LSM::postproc {

/// Rates of one catalogue.
struct ReleaseCurve {
  std::string label, model;
  std::vector<ReleaseBin> bins;
};

/// Labels of the axes, with units.
struct ReleaseNames {
  std::string time, events, released;
};

/// Both rates as points, in a panel each.
/// \throws DegenerateData if no curve has an event
Figure release_figure(const std::vector<ReleaseCurve> &curves, const ReleaseNames &names);

}  // namespace LSM::postproc

#endif
