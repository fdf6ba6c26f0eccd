// SPDX-License-Identifier: GPL-2.0-or-later
#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"

namespace LSM::postproc {

std::string short_number(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string with_error(double value, double error, std::string_view plus_minus) {
  if (!std::isfinite(value) || !std::isfinite(error) || !(error > 0.0)) return short_number(value);
  const double largest = std::max(std::abs(value), error);
  int exponent = static_cast<int>(std::floor(std::log10(largest)));
  if (exponent > -4 && exponent < 6) exponent = 0;
  const double scale = std::pow(10.0, -exponent);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error * scale))));
  const std::string pair =
      fmt::format("{:.{}f}{}{:.{}f}", value * scale, decimals, plus_minus, error * scale, decimals);
  return exponent == 0 ? pair : fmt::format("({})e{:+03d}", pair, exponent);
}

Range parse_range(const std::string &option, std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{-infinity, infinity};
  const std::size_t colon = text.find(':');
  const auto end = [](std::string_view field, double &value) {
    field = text_io::trim(field);
    return field.empty() || text_io::parse(field, value);
  };
  if (colon == std::string_view::npos || !end(text.substr(0, colon), range.lo) ||
      !end(text.substr(colon + 1), range.hi) || !(range.lo < range.hi))
    throw std::invalid_argument(option + " " + text_io::in_quotes(text) +
                                ", expected LO:HI with LO < HI (an end may be left out)");
  return range;
}

}  // namespace LSM::postproc
