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
  return without_numbers(none, fmt::format("the catalogue only has events from {:.4g}", least));
}

std::vector<SizeFit> fit_sizes(const std::vector<EventTable> &tables,
                               const SizeFitSettings &settings) {
  std::vector<SizeFit> fits;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::vector<double> sorted = column(tables[i].events, &Event::size);
    std::sort(sorted.begin(), sorted.end());
    const double least = tables[i].complete_from, step = tables[i].size_step();
    std::vector<PowerLawFit> laws;
    const double smallest = settings.threshold.of(tables[i]).size;
    for (const Range &range : settings.ranges) laws.push_back(fit_from(sorted, range, least, step));
    if (laws.empty() && smallest > 0.0)
      laws.push_back(fit_from(sorted, paper_range(smallest), least, step));
    if (settings.search || laws.empty()) laws.push_back(search_range(sorted, smallest, step));
    for (const PowerLawFit &law : laws) {
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
  if (!law.degenerate && !found.exponential.degenerate)
    found.gain = 2.0 * (found.exponential.log_likelihood - law.log_likelihood);
  return found;
}

std::vector<Scaling> scale_sizes(const std::vector<EventTable> &tables, const Threshold &threshold,
                                 const Resampling &resampling) {
  std::vector<Scaling> scalings;
  for (const EventTable &table : tables) {
    const double length = table.length();
    if (std::isnan(length)) continue;
    const std::string *const kl = table.info.find("kl");
    const std::string stiffness = kl ? *kl : "";
    auto found = std::find_if(scalings.begin(), scalings.end(), [&](const Scaling &scaling) {
      return scaling.model == table.info.model && scaling.stiffness == stiffness &&
             scaling.kind == table.kind();
    });
    if (found == scalings.end()) {
      scalings.emplace_back();
      found = scalings.end() - 1;
      found->model = table.info.model;
      found->stiffness = stiffness;
      found->kind = table.kind();
      // One threshold for all lengths, at which every catalogue is complete.
      found->threshold = threshold.of(table);
      if (found->threshold.origin == SmallestSize::Origin::catalogue)
        found->threshold.source = table.label;
      for (const EventTable &other : tables) {
        if (other.info.model != found->model || other.kind() != found->kind ||
            !(other.complete_from > found->threshold.size))
          continue;
        found->threshold = {other.complete_from, SmallestSize::Origin::catalogue, other.label};
      }
    }
    found->labels.push_back(table.label);
    // Each catalogue has its own seed, so that the bootstrap samples are independent.
    Resampling own = resampling;
    own.seed += found->points.size();
    found->points.push_back(characteristic_size(column(table.events, &Event::t_start),
                                                column(table.events, &Event::size),
                                                found->threshold.size, length, own));
  }
  for (Scaling &scaling : scalings) scaling.fit = fit_scaling(scaling.points);
  return scalings;
}

bool Scaling::drawable() const {
  return std::any_of(points.begin(), points.end(),
                     [](const SizePoint &point) { return !point.degenerate; });
}

bool Scaling::by_event() const {
  return std::none_of(points.begin(), points.end(),
                      [](const SizePoint &point) { return point.blocks > 0; });
}

}  // namespace LSM::postproc
