// SPDX-License-Identifier: GPL-2.0-or-later
#include "options.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "earthquakes.h"
#include "files/file_error.h"
#include "files/text.h"
#include "new_file.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// Parses a size, or M and a magnitude, which is converted to a size.
bool parse_size(std::string_view text, double &size) {
  const bool magnitude = text.substr(0, 1) == "M";
  if (!text::parse(text.substr(magnitude ? 1 : 0), size)) return false;
  if (magnitude) size = size_of_magnitude(size);
  return std::isfinite(size);
}

}  // namespace

Rule size_or_magnitude() {
  return transformed([](std::string &text) {
    double size = 0.0;
    if (text.empty() || text.front() != 'M') return std::string();
    if (!parse_size(text, size))
      return "expected a size, or M and a magnitude, not " + text::in_quotes(text);
    text = text::number(size);
    return std::string();
  });
}

Range parse_range(const std::string &option, std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{-infinity, infinity};
  const std::size_t colon = text.find(':');
  const auto end = [](std::string_view field, double &value) {
    field = text::trim(field);
    return field.empty() || parse_size(field, value);
  };
  if (colon == std::string_view::npos || !end(text.substr(0, colon), range.lo) ||
      !end(text.substr(colon + 1), range.hi) || !(range.lo < range.hi))
    throw std::invalid_argument(option + " " + text::in_quotes(text) +
                                ", expected LO:HI with LO < HI (an end may be left out)");
  return range;
}

PowerLine parse_guide(std::string_view text) {
  PowerLine line;
  const std::size_t colon = text.find(':');
  if (!text::parse(text::trim(text.substr(0, colon)), line.slope))
    throw std::invalid_argument("--guide " + text::in_quotes(text) +
                                ", expected SLOPE or SLOPE:LO:HI");
  if (colon != std::string_view::npos) {
    const Range range = parse_range("--guide", text.substr(colon + 1));
    if (!(range.lo > 0.0) || !std::isfinite(range.hi))
      throw std::invalid_argument("--guide " + text::in_quotes(text) +
                                  ", expected 0 < LO < HI after the slope");
    line.lo = range.lo;
    line.hi = range.hi;
  }
  line.title = fmt::format("slope {}", line.slope);
  return line;
}

void JsonOutput::add_to(CLI::App *command) {
  const auto given = [this](const std::string &path) {
    if (path.empty()) throw std::invalid_argument("--json '', expected the name of a file");
    path_ = path;
    if (path != "-") return;
    standard_output_ = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  };
  OptionGroup(command).call<std::string>(
      "--json", given,
      "Also write the numbers to this file, as JSON; -: to standard output, everything else to "
      "standard error",
      kind("FILE"), shown(""));
}

std::string JsonOutput::text_of(const nlohmann::ordered_json &found) {
  return found.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void JsonOutput::check(bool overwrite, const nlohmann::ordered_json *found) const {
  if (output().path.empty()) return;
  const std::string text = found ? text_of(*found) : "{";
  const Known known = begins_with(text.substr(0, text.find(':')));
  if (found)
    check_output(path_, overwrite, known);
  else
    check_replaced(path_, overwrite, known);
}

void JsonOutput::write(const nlohmann::ordered_json &found) const {
  if (path_.empty()) return;
  const std::string text = text_of(found);
  if (path_ != "-") {
    write_file(path_, text);
    fmt::print("wrote {}\n", path_);
    return;
  }
  std::FILE *const out = fdopen(standard_output_, "w");
  const bool written = out && std::fputs(text.c_str(), out) >= 0;
  if ((out && std::fclose(out) != 0) || !written)
    throw FileError("cannot write to standard output");
}

}  // namespace LSM::postproc
