// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_figures.h
/// Event sizes: their probability densities (paper: Figs. 7, 12, 13), and fitted exponents as a
/// table.
#ifndef LSM_POSTPROC_SIZE_FIGURES_H
#define LSM_POSTPROC_SIZE_FIGURES_H

#include <limits>
#include <string>
#include <vector>

#include "densities.h"
#include "plot.h"
#include "size_fits.h"

namespace LSM::postproc {

/// A straight line on logarithmic axes: amplitude * s^slope from lo to hi.
struct PowerLine {
  double slope = -1.0;
  double lo = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the range of the data
  double hi = std::numeric_limits<double>::quiet_NaN();
  /// NaN: chosen so that the line lies above all points.
  double amplitude = std::numeric_limits<double>::quiet_NaN();
  std::string title;  ///< in the key; empty: none
  /// Index of the catalogue whose colour the line has; an index that no catalogue has: black.
  std::size_t catalogue = std::numeric_limits<std::size_t>::max();
  int dash = 2;  ///< gnuplot dash type
};

/// Probability densities of the sizes. Catalogues without an event in the range have no curve.
Figure size_density_figure(const std::vector<SizeDensity> &densities,
                           const std::vector<PowerLine> &lines);

/// Fitted exponents, a row for each rival of each fit.
Table size_fit_table(const std::vector<SizeFit> &fits);
/// Returns a line for each fit that uses sizes below the completeness of its catalogue.
std::vector<std::string> completeness_notes(const std::vector<SizeFit> &fits);

/// The fitted law as a line for size_density_figure(), scaled to the density of the whole
/// catalogue.
PowerLine fitted_line(const SizeFit &fit, const SizeDensity &density);

}  // namespace LSM::postproc

#endif
