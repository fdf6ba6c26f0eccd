// SPDX-License-Identifier: GPL-2.0-or-later
/// \file picture_options.h
/// Options --output and --no-picture of the commands that draw.
#ifndef LSM_POSTPROC_PICTURE_OPTIONS_H
#define LSM_POSTPROC_PICTURE_OPTIONS_H

#include <string>

#include <CLI/CLI.hpp>

#include "plot.h"

namespace LSM::postproc {

/// \param base default of --output
void add_picture_options(CLI::App *command, PictureOptions &picture, const std::string &base);

/// For a further picture of a command: BASE + name.
PictureOptions named(const PictureOptions &options, const std::string &name);

}  // namespace LSM::postproc

#endif
