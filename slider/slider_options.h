// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_options.h
/// The command line of slider_cli: one run, or an ensemble of them.
#ifndef SLIDER_OPTIONS_H
#define SLIDER_OPTIONS_H

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "slider_run.h"

namespace Slider {

/// A parsed command line: its run, and what is needed to derive the runs of an ensemble.
struct Settings {
  RunOptions run;
  std::string config, summary, ensemble;
  std::vector<std::string> inputs;  ///< other files that are read
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

/// Prints help or version and ends the program if they are asked for.
/// \throws std::invalid_argument or std::runtime_error with one line
Settings parse(std::vector<std::string> arguments, const std::atomic<int> *stop);

/// Returns the runs of --ensemble, each with its own output files.
/// \param base what parse() has returned for the same arguments
/// \throws std::invalid_argument or std::runtime_error as parse()
std::vector<Settings> ensemble(const Settings &base, const std::vector<std::string> &arguments);

/// Checks that all outputs of all runs are different files, and that none of them is an input.
/// \throws std::invalid_argument naming options and file
void check_files(const std::vector<Settings> &all);

}  // namespace Slider

#endif
