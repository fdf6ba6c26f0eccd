// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/picker_options.h
/// Settings of the event picker from the command line of a program.
#ifndef LSM_PICKER_OPTIONS_H
#define LSM_PICKER_OPTIONS_H

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "events/event_picker.h"
#include "files/text_io.h"

namespace LSM {

/// The user's settings of the picker; empty where not given.
class PickerOptions {
 public:
  std::string prefix;  ///< between the dashes and the name of lambda and memory-time
  std::optional<std::string> reading;
  std::optional<double> lambda, memory_time, min_size;
  bool keep_nonpositive = false;

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
        fail(lambda_name(), shown(*lambda), "at least 0 and less than 1");
      settings.lambda = *lambda;
    } else if (memory_time) {
      if (!std::isfinite(*memory_time) || !(*memory_time > 0.0))
        fail(time_name(), shown(*memory_time), "a positive time");
      settings.lambda = lambda_from_memory_time(*memory_time, interval);
      if (!(settings.lambda < 1.0))
        fail(time_name(), shown(*memory_time), "less than 1e16 intervals of the samples");
    }
    if (min_size) settings.min_size = *min_size;
    if (!std::isfinite(settings.min_size) || !(settings.min_size >= 0.0))
      fail("--min-size", shown(settings.min_size), "a finite size of at least 0");
    settings.keep_nonpositive = settings.keep_nonpositive || keep_nonpositive;
    return settings;
  }

  std::string lambda_name() const { return "--" + prefix + "lambda"; }
  std::string time_name() const { return "--" + prefix + "memory-time"; }

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
};

}  // namespace LSM

#endif
