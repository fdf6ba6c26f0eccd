// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_fit_tables.h
/// Fitted size exponents and finite-size scaling as tables, JSON and a picture.
#ifndef LSM_POSTPROC_SIZE_FIT_TABLES_H
#define LSM_POSTPROC_SIZE_FIT_TABLES_H

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "plot.h"
#include "size_densities.h"
#include "size_fits.h"

namespace LSM::postproc {

/// A row for each rival of each fit.
Table size_fit_table(const std::vector<SizeFit> &fits);
/// Which fits reach below the completeness of their catalogue, a line each.
std::vector<std::string> completeness_notes(const std::vector<SizeFit> &fits);
nlohmann::json to_json(const SizeFit &fit);

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
nlohmann::json to_json(const Scaling &scaling);

/// s* against length with error bars, the fitted power law, the constant and, where it is
/// preferred, growth that ends. \throws std::runtime_error if no point can be drawn
Figure scaling_figure(const std::vector<Scaling> &scalings, int width = 900);

}  // namespace LSM::postproc

#endif
