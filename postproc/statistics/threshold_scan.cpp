// SPDX-License-Identifier: GPL-2.0-or-later
#include "threshold_scan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "files/text.h"
#include "size_fits.h"

namespace LSM::postproc {

namespace {

constexpr int most_decades = 12;
constexpr std::size_t fewest = 20;

/// mantissa x 10^decade, parsed from text: the double nearest to 1.3e-3 is not 1.3 * 1e-3.
double decimal(double mantissa, int decade) {
  double value = 0.0;
  text::parse(fmt::format("{:.1f}e{}", mantissa, decade), value);
  return value;
}

}  // namespace

std::vector<double> threshold_grid(const EventTable &table) {
  std::vector<double> sorted;
  for (const EventSummary &event : table.events)
    if (event.size > 0.0) sorted.push_back(event.size);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> grid;
  if (sorted.size() < fewest) return grid;
  const double last = sorted[sorted.size() - fewest];
  const int highest = static_cast<int>(std::floor(std::log10(last)));
  const int lowest = std::max(static_cast<int>(std::floor(std::log10(sorted.front()))),
                              highest - most_decades + 1);
  for (int decade = lowest; decade <= highest; ++decade)
    for (const double mantissa : {1.0, 1.3, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.3, 7.9}) {
      const double size = decimal(mantissa, decade);
      if (size >= sorted.front() && size <= last) grid.push_back(size);
    }
  const double usual = Threshold().of(table).size;
  if (usual <= last) grid.push_back(usual);
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

std::vector<ThresholdResult> scan_thresholds(const EventTable &table,
                                             const std::vector<double> &thresholds) {
  std::vector<ThresholdResult> results;
  if (thresholds.empty()) return results;
  const std::vector<double> sizes = sorted_sizes(table);
  IntervalSettings times;
  times.thresholds = thresholds;
  times.replicas = 0;
  std::vector<IntervalCurve> curves = interval_curves({table}, times);
  for (std::size_t k = 0; k < thresholds.size(); ++k) {
    PowerLawFit law = fit_from(sizes, paper_range(thresholds[k]), table);
    law.lo *= table.size_unit();
    law.hi *= table.size_unit();
    results.push_back({thresholds[k], std::move(law), std::move(curves[k])});
  }
  return results;
}

}  // namespace LSM::postproc
