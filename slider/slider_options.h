// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_options.h
/// The command line of slider_cli: one run, or an ensemble of them.
#ifndef SLIDER_OPTIONS_H
#define SLIDER_OPTIONS_H

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "lsm_picker_options.h"
#include "slider_run.h"

namespace Slider {

/// The command line as given; run is its interpretation.
struct Settings {
  RunOptions run;
  std::string scheme = "verlet", kernel = "active", events = "pe";
  LSM::PickerOptions picker;
  double steps = 1e7, time = 1e5;
  std::vector<double> friction = {0.5, 1.0};
  std::string config, friction_file, law = "velocity-weakening";
  double dynamic = 0.8, distance = 0.1;
  std::uint64_t seed = 1;
  std::string columns, summary, ensemble;
  double stride = 1, interval = 1e6, rupture_gap = 0.0;
  unsigned threads = 0;
  bool paper = false, force = false;
};

/// Help or version was asked for; what is to be printed, and nothing more to do.
struct Done {
  std::string text;
};

/// \throws Done; std::invalid_argument or std::runtime_error with one line
Settings parse(std::vector<std::string> arguments, const std::atomic<int> *stop);

/// The runs of --ensemble, each with output files of its own.
/// \param base of the same arguments \throws as parse()
std::vector<Settings> ensemble(const Settings &base, const std::vector<std::string> &arguments);

/// All outputs of all runs are different files, and none of them is an input.
/// \throws std::invalid_argument naming options and file
void check_files(const std::vector<Settings> &all);

}  // namespace Slider

#endif
