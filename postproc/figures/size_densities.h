// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_densities.h
/// Picture of the densities of event sizes (paper: Figs. 7, 12, 13).
#ifndef LSM_POSTPROC_SIZE_DENSITIES_H
#define LSM_POSTPROC_SIZE_DENSITIES_H

#include <limits>
#include <string>
#include <vector>

#include "densities.h"
#include "plot.h"

namespace LSM::postproc {

/// Straight line in the logarithms: amplitude * s^slope from lo to hi.
struct PowerLine {
  double slope = -1.0;
  double lo = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the range of the data
  double hi = std::numeric_limits<double>::quiet_NaN();
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< NaN: above all points
  std::string title;                                            ///< empty: no line in the key
  /// Index of the catalogue whose colour it has; none: black.
  std::size_t catalogue = std::numeric_limits<std::size_t>::max();
  int dash = 2;  ///< gnuplot dash type
};

/// Table and picture; catalogues without an event in the range have no curve.
Figure size_density_figure(const std::vector<SizeDensity> &densities,
                           const std::vector<PowerLine> &lines, int width = 900);

}  // namespace LSM::postproc

#endif
