// SPDX-License-Identifier: GPL-2.0-or-later
/// \file picker_options.h
/// The options of the event picker, declared once for all programs.
#ifndef LSM_PICKER_OPTIONS_H
#define LSM_PICKER_OPTIONS_H

#include <optional>
#include <string>

#include "events/event_picker.h"
#include "option_group.h"

namespace LSM {

/// The settings of the picker on the command line; those not given are empty.
class PickerOptions {
 public:
  std::string prefix;  ///< between the dashes and the name of lambda and memory-time
  std::optional<std::string> reading;
  std::optional<double> lambda, memory_time, min_size;
  bool keep_nonpositive = false;

  /// The options that were added, for further rules.
  struct Added {
    CLI::Option *reading, *lambda, *memory_time, *min_size, *keep_nonpositive;
  };
  /// Adds --picker and, with the prefix, lambda and memory-time; --min-size, --keep-nonpositive.
  Added add_to(OptionGroup group);

  /// Whether the leakiness is given, directly or by the memory time.
  bool says_lambda() const { return lambda || memory_time; }

  /// Returns the given settings, completed by those of `settings`.
  /// \param interval time between samples (model time)
  /// \throws std::invalid_argument naming the option, its value and what is expected
  PickerSettings over(PickerSettings settings, double interval) const;

  std::string lambda_name() const { return "--" + prefix + "lambda"; }
  std::string time_name() const { return "--" + prefix + "memory-time"; }
};

}  // namespace LSM

#endif
