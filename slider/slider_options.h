// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_options.h
/// The command line of slider_cli.
#ifndef SLIDER_OPTIONS_H
#define SLIDER_OPTIONS_H

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "slider_run.h"

namespace Slider {

/// A parsed command line: its run, and the other files.
struct Settings {
  RunOptions run;
  std::string config, summary;
  std::vector<std::string> inputs;  ///< other files that are read
  std::uint64_t seed = 1;
};

/// Prints help or version and ends the program if they are asked for.
/// \throws std::invalid_argument or std::runtime_error with one line
Settings parse(std::vector<std::string> arguments, const std::atomic<int> *stop);

/// Checks that all outputs are different files, and that none of them is an input.
/// \throws std::invalid_argument naming options and file
void check_files(Settings settings);

}  // namespace Slider

#endif
