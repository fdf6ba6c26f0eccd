// SPDX-License-Identifier: GPL-2.0-or-later
/// \file picker_options.h
/// The options of the event picker and of the filter behind it, declared once for all programs.
#ifndef LSM_PICKER_OPTIONS_H
#define LSM_PICKER_OPTIONS_H

#include <optional>
#include <string>

#include "events/event_filter.h"
#include "events/event_picker.h"
#include "option_group.h"

namespace LSM {

/// The settings of picker and filter that were given on the command line; the others are empty.
class PickerOptions {
 public:
  std::string prefix;  ///< of the names lambda and memory-time, after the dashes
  std::optional<std::string> reading;
  std::optional<double> lambda, memory_time, min_size;
  bool keep_nonpositive = false;

  /// The options that were added, for further rules.
  struct Added {
    CLI::Option *reading, *lambda, *memory_time, *min_size, *keep_nonpositive;
  };
  /// Adds --picker, --min-size, --keep-nonpositive and, with the prefix, lambda and memory-time.
  Added add_to(OptionGroup group);

  /// Whether the leakiness is given, directly or through the memory time.
  bool says_lambda() const { return lambda || memory_time; }

  /// Returns the given settings, completed by those of `settings`.
  /// \param interval time between samples (model time)
  /// \throws std::invalid_argument naming the option, its value and what is expected
  PickerSettings over(PickerSettings settings, double interval) const;
  FilterSettings over(FilterSettings settings) const;

  std::string lambda_name() const { return "--" + prefix + "lambda"; }
  std::string time_name() const { return "--" + prefix + "memory-time"; }
};

}  // namespace LSM

#endif
