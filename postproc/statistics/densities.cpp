// SPDX-License-Identifier: GPL-2.0-or-later
#include "densities.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samples.h"

namespace LSM::postproc {

SizeDensity size_density(const EventTable &table, const Threshold &threshold) {
  SizeDensity out;
  out.label = table.label;
  out.model = table.info.model;
  out.length = table.length();
  const double least = threshold.of(table).size;
  std::vector<double> sizes = column(table.events, &Event::size);
  if (sizes.empty()) return out;
  out.largest = *std::max_element(sizes.begin(), sizes.end());
  if (const double step = table.size_step(); step > 0.0) {
    for (std::size_t i = 0; i < sizes.size(); ++i)
      sizes[i] = size_of_magnitude(table.bins.binned(table.magnitudes[i]));
    const double unit = table.size_unit();
    const double smallest = std::max(least, *std::min_element(sizes.begin(), sizes.end()));
    const double first = std::ceil(std::log(smallest / unit) / step - magnitude_tolerance);
    const double edge = unit * std::exp((first - 0.5) * step);
    const double together = std::max(1.0, std::round(std::log(usual_bin_factor) / step));
    out.bins = log_histogram(sizes, std::exp(together * step), edge,
                             std::numeric_limits<double>::infinity(), edge);
  } else {
    out.bins = log_histogram(sizes, usual_bin_factor, least);
  }
  for (const LogBin &bin : out.bins) out.events += bin.count;
  return out;
}

std::vector<SizeDensity> size_densities(const std::vector<EventTable> &tables,
                                        const Threshold &threshold) {
  std::vector<SizeDensity> all;
  double least = std::numeric_limits<double>::infinity();
  bool any = false;
  Range sizes;
  std::size_t events = 0;
  expect_events(tables);
  for (const EventTable &table : tables) {
    all.push_back(size_density(table, threshold));
    least = std::min(least, threshold.of(table).size);
    any = any || !all.back().bins.empty();
    for (const EventSummary &event : table.events) sizes.add(event.size);
    events += table.events.size();
  }
  if (events > 1 && sizes.lo == sizes.hi)
    throw DegenerateData("all sizes are equal, nothing to draw");
  if (!any)
    throw DegenerateData(fmt::format(
        "no bin of sizes from {:.4g} on has an event in any catalogue, nothing to draw", least));
  return all;
}

double amplitude_of(const PowerLawFit &law, const SizeDensity &density) {
  // Integral of s^-alpha over the range. Without an upper end, expm1(-infinity) gives the right
  // limit.
  const double lo = law.lower_end(), power = 1.0 - law.alpha, logs = std::log(law.upper_end() / lo);
  const double integral =
      std::pow(lo, power) * (power == 0.0 ? logs : std::expm1(power * logs) / power);
  return static_cast<double>(law.n) / static_cast<double>(density.events) / integral;
}

}  // namespace LSM::postproc
