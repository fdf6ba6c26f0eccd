// SPDX-License-Identifier: GPL-2.0-or-later
#include "numbers.h"

#include <cmath>

#include <fmt/format.h>

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

const char *model_name(std::string_view model) {
  return model == "lsm" ? "fault" : model == "seismicity" ? "earthquakes" : "block-slider";
}

std::string text(const SmallestSize &smallest) {
  return short_number(smallest.size) + ", " + smallest.why;
}

std::vector<std::string> texts(const Threshold &threshold, const std::vector<EventTable> &tables) {
  std::vector<std::string> lines;
  for (const EventTable &table : tables) {
    std::string line = fmt::format("smallest size, {}: {}", model_name(table.info.model),
                                   text(threshold.of(table)));
    if (std::find(lines.begin(), lines.end(), line) == lines.end())
      lines.push_back(std::move(line));
  }
  return lines;
}

std::string text(const MagnitudeBins &bins) {
  return bins.offset > 0.0 ? fmt::format("{} around {} + n {}", bins.width, bins.offset, bins.width)
                           : fmt::format("{}", bins.width);
}

std::vector<std::string> bin_notes(const std::vector<EventTable> &tables) {
  std::vector<std::string> notes;
  for (const EventTable &table : tables) {
    const auto &[width, offset, share, wider, share_of_wider] = table.bins;
    std::string note;
    if (table.bins_given && table.earthquakes() && width > 0.0)
      note = fmt::format("magnitudes in bins of {}, as given", text(table.bins));
    else if (!table.bins_given && width > 0.0)
      note = fmt::format("magnitudes in bins of {}, of which {}", text(table.bins),
                         share == 1.0
                             ? fmt::format("all are {}", offset > 0.0 ? "centres" : "multiples")
                             : fmt::format("{:.0f} % are {}; the others are rounded", 100.0 * share,
                                           offset > 0.0 ? "centres" : "multiples"));
    if (!table.bins_given && wider > 0.0)
      note += fmt::format(
          "{}{:.0f} % of the magnitudes are multiples of {}, --magnitude-bin {} "
          "rounds all to these",
          note.empty() ? "" : "; ", 100.0 * share_of_wider, wider, wider);
    if (!note.empty()) notes.push_back(table.label + ": " + note);
  }
  return notes;
}

}  // namespace LSM::postproc
