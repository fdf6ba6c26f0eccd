// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_picker_options.h
/// The options of the event picker on the command line, declared once for all programs that have
/// CLI11.
#ifndef LSM_PICKER_OPTIONS_H
#define LSM_PICKER_OPTIONS_H

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "lsm_event_picker.h"
#include "lsm_text_io.h"

namespace LSM {

/// What a user says about the picker; what he does not say is empty.
class PickerOptions {
 public:
  std::optional<std::string> reading;
  std::optional<double> lambda, memory_time, min_size;
  bool keep_nonpositive = false;

  /// Options as they were added, for default texts and for what excludes them.
  struct Added {
    CLI::Option *reading, *lambda, *memory_time, *min_size, *keep_nonpositive;
  };

  /// Adds --picker and, with prefix between the dashes and the name, lambda and memory-time; and
  /// --min-size, --keep-nonpositive.
  Added add_to(CLI::App *command, const std::string &group, const std::string &prefix = "") {
    lambda_name_ = "--" + prefix + "lambda";
    time_name_ = "--" + prefix + "memory-time";
    Added o;
    o.reading = command->add_option(
        "--picker", reading,
        "Reading of the paper's formula for the smoothed change A of PE (x: change): exponential, "
        "A "
        "<- lambda A + (1 - lambda) x (ours, the default); average, A <- (x + lambda A) / (1 + "
        "lambda) (ours); literal, A <- (x + lambda A) / (1 + lambda t) (paper, Sect. 4.1; t: index "
        "of the change)");
    o.lambda = command->add_option(lambda_name_, lambda,
                                   "Leakiness per sample, 0 to less than 1 (paper: 0.99)");
    o.memory_time = command->add_option(
        time_name_, memory_time,
        "Memory of the picker, lambda = exp(-interval of the samples / memory) (model time; ours)");
    o.min_size = command->add_option(
        "--min-size", min_size, "Events of smaller size are counted, not written (energy; ours)");
    o.keep_nonpositive = command->add_flag("--keep-nonpositive", keep_nonpositive,
                                           "Write events of size <= 0, too, whatever --min-size is "
                                           "(ours); otherwise they are counted");
    o.memory_time->excludes(o.lambda);
    for (CLI::Option *option : {o.reading, o.lambda, o.memory_time, o.min_size, o.keep_nonpositive})
      option->group(group);
    return o;
  }

  /// Whether the leakiness is said, in one way or another.
  bool says_lambda() const { return lambda || memory_time; }

  /// The settings, those that nothing is said about as they are in settings.
  /// \param interval time between samples (model time)
  /// \throws std::invalid_argument naming the option, its value and what is expected
  PickerSettings over(PickerSettings settings, double interval) const {
    if (reading && !from_string(*reading, settings.reading))
      fail("--picker", text_io::in_quotes(*reading), choices(settings.reading));
    if (lambda) {
      if (!(*lambda >= 0.0 && *lambda < 1.0))
        fail(lambda_name_, shown(*lambda), "at least 0 and less than 1");
      settings.lambda = *lambda;
    } else if (memory_time) {
      if (!std::isfinite(*memory_time) || !(*memory_time > 0.0))
        fail(time_name_, shown(*memory_time), "a positive time");
      settings.lambda = lambda_from_memory_time(*memory_time, interval);
      if (!(settings.lambda < 1.0))
        fail(time_name_, shown(*memory_time), "less than 1e16 intervals of the samples");
    }
    if (min_size) settings.min_size = *min_size;
    if (!std::isfinite(settings.min_size) || !(settings.min_size >= 0.0))
      fail("--min-size", shown(settings.min_size), "a finite size of at least 0");
    settings.keep_nonpositive = settings.keep_nonpositive || keep_nonpositive;
    return settings;
  }

  const std::string &time_name() const { return time_name_; }

 private:
  [[noreturn]] static void fail(const std::string &option, const std::string &value,
                                const std::string &expected) {
    throw std::invalid_argument(option + " = " + value + ", expected " + expected);
  }
  static std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
  }

  std::string lambda_name_ = "--lambda", time_name_ = "--memory-time";
};

}  // namespace LSM

#endif
