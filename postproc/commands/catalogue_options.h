// SPDX-License-Identifier: GPL-2.0-or-later
/// \file catalogue_options.h
/// The options that select catalogues and their events.
#ifndef LSM_POSTPROC_CATALOGUE_OPTIONS_H
#define LSM_POSTPROC_CATALOGUE_OPTIONS_H

#include <string>
#include <vector>

#include "catalogue_input.h"
#include "options.h"

namespace LSM::postproc {

/// Adds the arguments for catalogues and the options that select events to a command.
void add_catalogues(CLI::App *command, CatalogueOptions &of);
/// Adds --displacement, for commands whose output does not state a unit of time.
void add_displacement(CLI::App *command, CatalogueOptions &of);
/// Adds --magnitude-bin, for commands whose results depend on it.
void add_magnitude_bin(CLI::App *command, CatalogueOptions &of);

/// Adds --threshold.
void add_threshold(OptionGroup group, Threshold &threshold);
/// Adds --threshold, which may be given several times.
void add_thresholds(OptionGroup group, std::vector<double> &thresholds);

}  // namespace LSM::postproc

#endif
