// SPDX-License-Identifier: GPL-2.0-or-later
/// \file magnitude_figure.h
/// Frequencies of magnitudes and b-values, as a table and a figure †.
#ifndef LSM_POSTPROC_MAGNITUDE_FIGURE_H
#define LSM_POSTPROC_MAGNITUDE_FIGURE_H

#include <string>
#include <vector>

#include "magnitudes.h"
#include "plot.h"

namespace LSM::postproc {

/// Magnitudes of one catalogue, with their completeness and b-values.
struct MagnitudeCurve {
  std::string label, model;
  std::vector<double> magnitudes;  ///< in order of time
  double completeness = 0.0;
  std::string completeness_text;  ///< where the completeness comes from
  double curvature = 0.0;         ///< magnitude of completeness by maximum curvature
  BValue b, positive;
  MagnitudeBins bins;      ///< of the magnitudes
  MagnitudeBins counting;  ///< those in which they are counted and drawn, of a width > 0
};

/// Magnitudes of completeness and b-values, a row per catalogue.
Table magnitude_table(const std::vector<MagnitudeCurve> &curves);

/// Numbers of events per bin and cumulative numbers of events from each magnitude on, with the
/// fitted laws.
/// \throws DegenerateData if no curve has an event
Figure magnitude_figure(const std::vector<MagnitudeCurve> &curves);

}  // namespace LSM::postproc

#endif
