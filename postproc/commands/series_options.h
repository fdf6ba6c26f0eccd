// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_options.h
/// The options of commands that read a PE series, and of the picker.
#ifndef LSM_POSTPROC_SERIES_OPTIONS_H
#define LSM_POSTPROC_SERIES_OPTIONS_H

#include <string>

#include "picker_options.h"
#include "series_input.h"

namespace LSM::postproc {

/// Adds the argument of commands that read one series, and --lenient.
/// \param window whether to add --from and --to as well
void add_series(OptionGroup group, std::string &path, SeriesOptions &of, bool window);

/// Adds the options of the picker to a command.
void add_picker_options(CLI::App *command, PickerOptions &options);

/// Settings of picker and filter from the options. Those not given come from the header of the
/// series, so that picking afterwards repeats what the run picked, or else are the defaults. The
/// filter has no warm-up.
/// \throws std::invalid_argument naming the option that is out of range
PickerSettings picker_settings(const PickerOptions &options, const PeSeriesInfo &info);
FilterSettings filter_settings(const PickerOptions &options, const PeSeriesInfo &info);

}  // namespace LSM::postproc

#endif
