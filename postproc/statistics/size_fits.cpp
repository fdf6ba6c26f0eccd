// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_fits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace LSM::postproc {

PowerLawFit fit_from(const std::vector<double> &sorted, const Range &range, double least,
                     double step) {
  if (least < range.hi) return fit_power_law(sorted, std::max(range.lo, least), range.hi, step);
  PowerLawFit none;
  none.lo = range.lo;
  none.hi = range.hi;
  return without_numbers(none, least > 0.0
                                   ? fmt::format("the catalogue only has events from {:.4g}", least)
                                   : "no events");
}

std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings) {
  std::vector<SizeFit> fits;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::vector<double> sorted = column(tables[i].events, &Event::size);
    std::sort(sorted.begin(), sorted.end());
    const double least = tables[i].complete_from, step = tables[i].size_step();
    std::vector<Range> ranges = settings.ranges;
    if (ranges.empty()) ranges.push_back(paper_range(settings.threshold.of(tables[i]).size));
    for (const Range &range : ranges) {
      const PowerLawFit law = fit_from(sorted, range, least, step);
      SizeFit fit;
      fit.label = tables[i].label;
      fit.model = tables[i].info.model;
      fit.catalogue = i;
      fit.completeness = tables[i].info.completeness();
      fit.fit = law;
      if (!law.degenerate && settings.replicas > 0)
        fit.p = share_of(p_value(law, sorted, settings.replicas, settings.seed), settings.replicas);
      if (!law.degenerate && settings.compare) fit.comparisons = compare(sorted, law);
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
