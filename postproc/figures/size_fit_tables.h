// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_fit_tables.h
/// Fitted size exponents and finite-size scaling as text, tables, JSON and a picture.
#ifndef LSM_POSTPROC_SIZE_FIT_TABLES_H
#define LSM_POSTPROC_SIZE_FIT_TABLES_H

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "plot.h"
#include "size_densities.h"
#include "size_fits.h"

namespace LSM::postproc {

/// "0.001 to 1", with what search_range() found marked.
std::string range_text(const PowerLawFit &fit);
std::string size_fits_text(const std::vector<SizeFit> &fits);
Table size_fits_csv(const std::vector<SizeFit> &fits);
nlohmann::json to_json(const SizeFit &fit);

/// Density of the whole catalogue along the fitted law, for size_density_figure().
/// \param settings those of the densities, which set the normalisation
PowerLine fitted_line(const SizeFit &fit, const EventTable &table,
                      const SizeDensitySettings &settings);

/// Which law a comparison that is not degenerate favours; p below 0.05 decides (ours).
const char *favoured(const Comparison &comparison);
/// favoured() with the numbers, or "degenerate: why".
std::string verdict(const Comparison &comparison);

/// The model, with the stiffness of its leaf springs.
std::string name_of(const Scaling &scaling);
/// One sentence on whether the characteristic size depends on the length.
std::string verdict(const Scaling &scaling);
std::string scaling_text(const Scaling &scaling);
nlohmann::json to_json(const Scaling &scaling);

/// s* against length with error bars, the fitted power law, the constant and, where it is
/// preferred, growth that ends. \throws std::runtime_error if no point can be drawn
Figure scaling_figure(const std::vector<Scaling> &scalings, int width = 900);

}  // namespace LSM::postproc

#endif
