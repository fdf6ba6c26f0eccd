// SPDX-License-Identifier: GPL-2.0-or-later
/// \file aftershock_figure.h
/// Rates of events after main shocks as table and picture †.
#ifndef LSM_POSTPROC_AFTERSHOCK_FIGURE_H
#define LSM_POSTPROC_AFTERSHOCK_FIGURE_H

#include <string>
#include <vector>

#include "aftershocks.h"
#include "plot.h"

namespace LSM::postproc {

struct AftershockCurve {
  std::string label, model;
  Aftershocks aftershocks;
};

Table aftershock_table(const std::vector<AftershockCurve> &curves);
/// p and the ratio of after- to foreshocks over the catalogues that share a label.
Table aftershock_means(const std::vector<AftershockCurve> &curves);

/// Rate against time with Poisson errors, the fitted law, and the rates of Poisson catalogues (mean
/// and two standard deviations). \throws std::runtime_error if no curve has a point
Figure aftershock_figure(const std::vector<AftershockCurve> &curves);

}  // namespace LSM::postproc

#endif
