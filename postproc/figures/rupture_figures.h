// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_figures.h
/// Pictures of the ruptures of a fault (all ours).
#ifndef LSM_POSTPROC_RUPTURE_FIGURES_H
#define LSM_POSTPROC_RUPTURE_FIGURES_H

#include <vector>

#include "plot.h"
#include "ruptures.h"

namespace LSM::postproc {

/// Their numbers by length and by moment, moment against length, drop of the total PE against
/// moment, and stress drop against moment.
/// \throws std::runtime_error if there is nothing to draw
Figure rupture_density_figure(const std::vector<EventTable> &tables, RuptureQuantity quantity);
Figure moment_length_figure(const std::vector<EventTable> &tables);
Figure moment_pe_figure(const std::vector<EventTable> &tables);
Figure stress_drop_figure(const std::vector<EventTable> &tables);

}  // namespace LSM::postproc

#endif
