// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_figures.h
/// Event sizes: their densities (paper: Figs. 7, 12, 13), and fitted exponents and finite-size
/// scaling as tables, JSON and a picture.
#ifndef LSM_POSTPROC_SIZE_FIGURES_H
#define LSM_POSTPROC_SIZE_FIGURES_H

#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "densities.h"
#include "plot.h"
#include "size_fits.h"

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

/// A row for each rival of each fit.
Table size_fit_table(const std::vector<SizeFit> &fits);
/// Which fits reach below the completeness of their catalogue, a line each.
std::vector<std::string> completeness_notes(const std::vector<SizeFit> &fits);
void to_json(nlohmann::json &out, const SizeFit &fit);

/// Density of the whole catalogue along the fitted law, for size_density_figure().
PowerLine fitted_line(const SizeFit &fit, const SizeDensity &density);

/// The model, with the stiffness of its leaf springs.
std::string name_of(const Scaling &scaling);
/// One sentence on whether the characteristic size depends on the length.
std::string verdict(const Scaling &scaling);
/// The same with the model, the smallest size, and where the errors come from.
std::string scaling_text(const Scaling &scaling);
/// Characteristic sizes against length, a row for each catalogue.
Table scaling_table(const std::vector<Scaling> &scalings);
void to_json(nlohmann::json &out, const Scaling &scaling);

/// s* against length with error bars, the fitted power law, the constant and, where it is
/// preferred, growth that ends. \throws std::runtime_error if no point can be drawn
Figure scaling_figure(const std::vector<Scaling> &scalings, int width = 900);

}  // namespace LSM::postproc

#endif
