// SPDX-License-Identifier: GPL-2.0-or-later
#include "picker_options.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "files/text.h"

namespace LSM {

namespace {

[[noreturn]] void fail(const std::string &option, const std::string &value,
                       const std::string &expected) {
  throw std::invalid_argument(option + " = " + value + ", expected " + expected);
}

std::string digits(double value) { return fmt::format("{:.10g}", value); }

}  // namespace

PickerOptions::Added PickerOptions::add_to(OptionGroup group) {
  Added added;
  added.reading = group.add(
      "--picker", reading,
      "How the paper's formula for the smoothed change A of PE is read (x: change): exponential, A "
      "<- lambda A + (1 - lambda) x † (the default); average, A <- (x + lambda A) / (1 + "
      "lambda) †; literal, A <- (x + lambda A) / (1 + lambda t) (paper, Sect. 4.1; t: index "
      "of the change)");
  added.lambda =
      group.add(lambda_name(), lambda, "Leakiness per sample, 0 to less than 1 (paper: 0.99)");
  added.memory_time = group.add(
      time_name(), memory_time,
      "Memory of the picker, lambda = exp(-interval of the samples / memory) (model time) †",
      excludes(added.lambda));
  added.min_size = group.add("--min-size", min_size,
                             "Events of smaller size are counted, not written (energy) †");
  added.keep_nonpositive = group.flag("--keep-nonpositive", keep_nonpositive,
                                      "Write events of size <= 0, too, whatever --min-size is "
                                      "†; otherwise they are counted");
  return added;
}

PickerSettings PickerOptions::over(PickerSettings settings, double interval) const {
  if (reading && !from_string(*reading, settings.reading))
    fail("--picker", text::in_quotes(*reading), choices(settings.reading));
  if (lambda) {
    if (!(*lambda >= 0.0 && *lambda < 1.0))
      fail(lambda_name(), digits(*lambda), "at least 0 and less than 1");
    settings.lambda = *lambda;
  } else if (memory_time) {
    if (!std::isfinite(*memory_time) || !(*memory_time > 0.0))
      fail(time_name(), digits(*memory_time), "a positive time");
    settings.lambda = lambda_from_memory_time(*memory_time, interval);
    if (!(settings.lambda < 1.0))
      fail(time_name(), digits(*memory_time), "less than 1e16 intervals of the samples");
  }
  return settings;
}

FilterSettings PickerOptions::over(FilterSettings settings) const {
  if (min_size) settings.min_size = *min_size;
  if (!std::isfinite(settings.min_size) || !(settings.min_size >= 0.0))
    fail("--min-size", digits(settings.min_size), "a finite size of at least 0");
  settings.keep_nonpositive = settings.keep_nonpositive || keep_nonpositive;
  return settings;
}

}  // namespace LSM
