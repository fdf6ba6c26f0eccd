// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_figures.h
/// Pictures of the ruptures of a fault (all ours).
#ifndef LSM_POSTPROC_RUPTURE_FIGURES_H
#define LSM_POSTPROC_RUPTURE_FIGURES_H

#include <string>
#include <vector>

#include "plot.h"
#include "ruptures.h"

namespace LSM::postproc {

/// Numbers of the ruptures of one catalogue, see rupture_densities().
struct RuptureDensity {
  std::string label;
  double fault = 0.0;  ///< length of the fault
  std::vector<LogBin> bins;
};

/// Their numbers by length or by moment.
/// \param limit smallest moment that is seen; 0: not known
/// \throws std::runtime_error if there is nothing to draw
Figure rupture_density_figure(const std::vector<RuptureDensity> &densities,
                              RuptureQuantity quantity, double limit);

/// Moment against length, drop of the total PE against moment, and stress drop against moment.
Figure moment_length_figure(const RuptureRelations &relations);
Figure moment_pe_figure(const RuptureRelations &relations);
Figure stress_drop_figure(const RuptureRelations &relations);

}  // namespace LSM::postproc

#endif
