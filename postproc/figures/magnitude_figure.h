// SPDX-License-Identifier: GPL-2.0-or-later
/// \file magnitude_figure.h
/// Frequencies of magnitudes and b-values as table and picture †.
#ifndef LSM_POSTPROC_MAGNITUDE_FIGURE_H
#define LSM_POSTPROC_MAGNITUDE_FIGURE_H

#include <string>
#include <vector>

#include "magnitudes.h"
#include "plot.h"

namespace LSM::postproc {

/// One catalogue.
struct MagnitudeCurve {
  std::string label, model;
  std::vector<double> magnitudes;  ///< in order of time
  double completeness = 0.0;
  std::string completeness_text;  ///< where it comes from
  double curvature = 0.0;         ///< completeness by maximum curvature
  BValue b, positive;
};

/// \param slope of the magnitudes \param formula of them, for people
Table magnitude_table(const std::vector<MagnitudeCurve> &curves, double slope,
                      const std::string &formula, double width);

/// Numbers of events in each bin and from each magnitude on, with the fitted laws.
/// \param width of the bins, > 0 \throws std::runtime_error if no curve has an event
Figure magnitude_figure(const std::vector<MagnitudeCurve> &curves, double width);

}  // namespace LSM::postproc

#endif
