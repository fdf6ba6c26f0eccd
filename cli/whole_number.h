// SPDX-License-Identifier: GPL-2.0-or-later
/// \file whole_number.h
/// A check for options of unsigned type, shared by the programs: CLI11 turns negative numbers into
/// huge ones, and numbers that are too large into the largest one.
#ifndef LSM_CLI_WHOLE_NUMBER_H
#define LSM_CLI_WHOLE_NUMBER_H

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "files/text_io.h"

namespace LSM {

inline CLI::Validator whole_number(std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  return CLI::Validator(
      [most](std::string &text) {
        std::uint64_t value = 0;
        const char *const end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data(), end, value);
        return parsed.ec == std::errc() && parsed.ptr == end && value <= most
                   ? std::string()
                   : "expected a whole number from 0 to " + std::to_string(most) + ", not " +
                         text_io::in_quotes(text);
      },
      "");
}

}  // namespace LSM

#endif
