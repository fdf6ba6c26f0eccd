// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_densities.h
/// How many ruptures of each length and moment there are (ours), for faults of any length.
#ifndef LSM_POSTPROC_RUPTURE_DENSITIES_H
#define LSM_POSTPROC_RUPTURE_DENSITIES_H

#include <vector>

#include "log_histogram.h"
#include "plot.h"
#include "rupture_figures.h"

namespace LSM::postproc {

enum class RuptureQuantity { length, moment };

/// Ruptures per unit of model time, of length of the fault, and of the quantity, so that faults of
/// other lengths lie on each other where ruptures do not know the length. Moments in bins of equal
/// width in the logarithm. Lengths are whole numbers of bins of the fault: a bin of the density
/// holds as many of these numbers as its width says, one each for the shortest.
/// `density` and `error` are in these units, not normalised to one.
/// Empty if there is no time between the first start and the last end, or no rupture.
std::vector<LogBin> rupture_densities(const RuptureTable &table, RuptureQuantity quantity);

/// \throws std::runtime_error if there is nothing to draw
Figure rupture_density_figure(const std::vector<RuptureTable> &tables, RuptureQuantity quantity);

}  // namespace LSM::postproc

#endif
