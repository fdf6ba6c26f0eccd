// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_fits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace LSM::postproc {

std::vector<double> sorted_sizes(const EventTable &table) {
  std::vector<double> sorted = column(table.events, &Event::size);
  std::sort(sorted.begin(), sorted.end());
  for (double &size : sorted) size /= table.size_unit();
  return sorted;
}

PowerLawFit fit_from(const std::vector<double> &sorted, const Range &range,
                     const EventTable &table) {
  const double least = table.complete_from, unit = table.size_unit();
  if (least < range.hi)
    return fit_power_law(sorted, std::max(range.lo, least) / unit, range.hi / unit,
                         table.size_step());
  PowerLawFit none;
  none.lo = range.lo / unit;
  none.hi = range.hi / unit;
  return without_numbers(none, least > 0.0
                                   ? fmt::format("the catalogue only has events from {:.4g}", least)
                                   : "no events");
}

std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings) {
  std::vector<SizeFit> fits;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::vector<double> sorted = sorted_sizes(tables[i]);
    const double unit = tables[i].size_unit();
    std::vector<Range> ranges = settings.ranges;
    if (ranges.empty()) ranges.push_back(paper_range(settings.threshold.of(tables[i]).size));
    for (const Range &range : ranges) {
      const PowerLawFit law = fit_from(sorted, range, tables[i]);
      SizeFit fit;
      fit.label = tables[i].label;
      fit.model = tables[i].info.model;
      fit.catalogue = i;
      fit.completeness = tables[i].info.completeness();
      fit.fit = law;
      if (!law.degenerate && settings.replicas > 0)
        fit.p = share_of(p_value(law, sorted, settings.replicas, settings.seed), settings.replicas);
      if (!law.degenerate && settings.compare) fit.comparisons = compare(sorted, law);
      fit.fit.lo *= unit;
      fit.fit.hi *= unit;
      fits.push_back(std::move(fit));
    }
  }
  return fits;
}

RollOff roll_off(const EventTable &table, double least) {
  std::vector<double> sizes = column_from(table, least, &EventSummary::size);
  std::sort(sizes.begin(), sizes.end());
  RollOff found;
  found.free = fit_maximum_likelihood(sizes, least);
  found.exponential = fit_maximum_likelihood(sizes, least, 1.0);
  const PowerLawFit law = fit_power_law(sizes, least);
  if (!law.degenerate)  // without a fall-off the optimum is that of the power law, but for rounding
    found.gain = 2.0 * (found.exponential.log_likelihood - law.log_likelihood);
  if (found.gain < 0.0) found.gain = 0.0;
  return found;
}

}  // namespace LSM::postproc
