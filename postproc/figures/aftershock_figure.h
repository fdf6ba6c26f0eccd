// SPDX-License-Identifier: GPL-2.0-or-later
/// \file aftershock_figure.h
/// Event rates after main shocks, as tables and a figure †.
#ifndef LSM_POSTPROC_AFTERSHOCK_FIGURE_H
#define LSM_POSTPROC_AFTERSHOCK_FIGURE_H

#include <string>
#include <vector>

#include "aftershocks.h"
#include "plot.h"

namespace LSM::postproc {

/// Aftershock statistics of one catalogue.
struct AftershockCurve {
  std::string label, model;
  Aftershocks aftershocks;
};

/// Numbers of the main shocks and aftershocks and the fitted Omori-Utsu law, a row per catalogue.
Table aftershock_table(const std::vector<AftershockCurve> &curves);

/// Event rate against the time since the end of a main shock, with Poisson errors, the fitted law,
/// and the rates of Poisson catalogues (mean and two standard deviations).
/// \throws DegenerateData if no curve has a point
Figure aftershock_figure(const std::vector<AftershockCurve> &curves);

}  // namespace LSM::postproc

#endif
