// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/header_values.h"

#include <limits>
#include <string_view>

#include "events/event_picker.h"
#include "files/names.h"
#include "files/text.h"

namespace LSM {

std::string bad_value(const std::string &key, const std::string &value) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double above_0 = std::numeric_limits<double>::denorm_min();
  struct Number {
    std::string_view key;
    double least, below;
    const char *expected;
  };
  constexpr Number numbers[] = {
      {"completeness", 0.0, infinity, "a finite size of at least 0"},
      {"min_size", 0.0, infinity, "a finite size of at least 0"},
      {"lambda", 0.0, 1.0, "a number of at least 0 and less than 1"},
      {"warmup", -infinity, infinity, "a finite time"},
      {"length", above_0, infinity, "a positive length"},
      {"dt", above_0, infinity, "a positive number"},
      {"blocks", above_0, infinity, "a positive number of blocks"},
  };
  const auto expected = [&](const std::string &what) {
    return key + " is " + text_io::in_quotes(value) + ", expected " + what;
  };
  for (const Number &one : numbers) {
    double number = 0.0;
    if (key == one.key &&
        !(text_io::parse(value, number) && number >= one.least && number < one.below))
      return expected(one.expected);
  }
  PickerReading reading{};
  if (key == "picker" && !from_string(value, reading)) return expected(choices(reading));
  if (key == "keep_nonpositive" && value != "yes" && value != "no") return expected("yes or no");
  return {};
}

}  // namespace LSM
