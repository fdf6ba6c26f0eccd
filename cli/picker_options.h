// SPDX-License-Identifier: GPL-2.0-or-later
/// \file picker_options.h
/// The options of the event picker, declared once for all programs.
#ifndef LSM_CLI_PICKER_OPTIONS_H
#define LSM_CLI_PICKER_OPTIONS_H

#include <string>

#include <CLI/CLI.hpp>

#include "events/picker_options.h"

namespace LSM {

/// Options as they were added, for default texts and for what excludes them.
struct AddedPickerOptions {
  CLI::Option *reading, *lambda, *memory_time, *min_size, *keep_nonpositive;
};

/// Adds --picker and, with the prefix, lambda and memory-time; and --min-size, --keep-nonpositive.
inline AddedPickerOptions add_picker_options(CLI::App *command, PickerOptions &options,
                                             const std::string &group) {
  AddedPickerOptions o;
  o.reading = command->add_option(
      "--picker", options.reading,
      "Reading of the paper's formula for the smoothed change A of PE (x: change): exponential, "
      "A "
      "<- lambda A + (1 - lambda) x † (the default); average, A <- (x + lambda A) / (1 + "
      "lambda) †; literal, A <- (x + lambda A) / (1 + lambda t) (paper, Sect. 4.1; t: index "
      "of the change)");
  o.lambda = command->add_option(options.lambda_name(), options.lambda,
                                 "Leakiness per sample, 0 to less than 1 (paper: 0.99)");
  o.memory_time = command->add_option(
      options.time_name(), options.memory_time,
      "Memory of the picker, lambda = exp(-interval of the samples / memory) (model time) †");
  o.min_size = command->add_option("--min-size", options.min_size,
                                   "Events of smaller size are counted, not written (energy) †");
  o.keep_nonpositive = command->add_flag("--keep-nonpositive", options.keep_nonpositive,
                                         "Write events of size <= 0, too, whatever --min-size is "
                                         "†; otherwise they are counted");
  o.memory_time->excludes(o.lambda);
  for (CLI::Option *option : {o.reading, o.lambda, o.memory_time, o.min_size, o.keep_nonpositive})
    option->group(group);
  return o;
}

}  // namespace LSM

#endif
