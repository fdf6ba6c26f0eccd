// SPDX-License-Identifier: GPL-2.0-or-later
#include "option_values.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "earthquakes.h"
#include "lsm_text_io.h"
#include "lsm_whole_number.h"

namespace LSM::postproc {

CLI::Validator zero_or_more() {
  return CLI::Validator(
      [](std::string &text) {
        double value = 0.0;
        return text_io::parse(text, value) && value >= 0.0
                   ? std::string()
                   : "expected a number of 0 or more, not " + text_io::in_quotes(text);
      },
      "");
}

CLI::Option *add_seed(CLI::App *command, std::uint64_t &seed) {
  return command->add_option("--seed", seed, "Seed of the random numbers")->check(whole_number());
}

CLI::Validator size_or_magnitude() {
  return CLI::Validator(
      [](std::string &text) {
        double magnitude = 0.0;
        if (text.empty() || text.front() != 'M') return std::string();
        if (!text_io::parse(std::string_view(text).substr(1), magnitude))
          return "expected a size, or M and a magnitude, not " + text_io::in_quotes(text);
        text = text_io::number(size_of_magnitude(magnitude));
        return std::string();
      },
      "");
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

PowerLine parse_guide(std::string_view text) {
  PowerLine line;
  const std::size_t colon = text.find(':');
  if (!text_io::parse(text_io::trim(text.substr(0, colon)), line.slope))
    throw std::invalid_argument("--guide " + text_io::in_quotes(text) +
                                ", expected SLOPE or SLOPE:LO:HI");
  if (colon != std::string_view::npos) {
    const Range range = parse_range("--guide", text.substr(colon + 1));
    if (!(range.lo > 0.0) || !std::isfinite(range.hi))
      throw std::invalid_argument("--guide " + text_io::in_quotes(text) +
                                  ", expected 0 < LO < HI after the slope");
    line.lo = range.lo;
    line.hi = range.hi;
  }
  line.title = fmt::format("slope {}", line.slope);
  return line;
}

double parse_block(const std::string &text) {
  double block = std::numeric_limits<double>::quiet_NaN();
  if (text != "auto" && !(text_io::parse(text, block) && block >= 0.0))
    throw std::invalid_argument("--block " + text_io::in_quotes(text) +
                                ", expected 'auto' or a time of 0 or more");
  return block;
}

void add_wave_speeds(CLI::App *command, double &p_speed, double &s_speed,
                     const std::string &group) {
  command
      ->add_option(
          "--p-speed", p_speed,
          "Speed of P-waves (paper, Eq. 4: 2.12 for k = m0 = 1, the regular lattice; 2.0 to 2.1 in "
          "packings of create_lsm_fault)")
      ->check(CLI::PositiveNumber)
      ->group(group);
  command
      ->add_option("--s-speed", s_speed,
                   "Speed of S-waves (ours: that of P-waves over the root of 3, as in the regular "
                   "lattice; 1.0 to 1.1 in packings)")
      ->check(CLI::PositiveNumber)
      ->group(group);
}

}  // namespace LSM::postproc
