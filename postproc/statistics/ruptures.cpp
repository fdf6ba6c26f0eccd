// SPDX-License-Identifier: GPL-2.0-or-later
#include "ruptures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

// Lengths in bins of the fault from lo to hi - 1, as wide as ten bins a decade where that is more
// than one.
std::vector<LogBin> length_bins(const EventTable &table, double bin) {
  std::map<std::int64_t, std::int64_t> counts;
  for (const Event &e : table.events)
    ++counts[std::max<std::int64_t>(1, std::llround(e.rupture_length / bin))];
  std::vector<LogBin> bins;
  for (std::int64_t lo = 1; !counts.empty() && lo <= counts.rbegin()->first;) {
    const std::int64_t hi =
        std::max(lo + 1, static_cast<std::int64_t>(
                             std::llround(LogHistogram::default_factor * static_cast<double>(lo))));
    LogBin one{};
    // Between the integers.
    one.lo = (static_cast<double>(lo) - 0.5) * bin;
    one.hi = (static_cast<double>(hi) - 0.5) * bin;
    one.centre = std::sqrt(static_cast<double>(lo) * static_cast<double>(hi - 1)) * bin;
    for (auto at = counts.lower_bound(lo); at != counts.end() && at->first < hi; ++at)
      one.count += at->second;
    bins.push_back(one);
    lo = hi;
  }
  return bins;
}

}  // namespace

LogFit fit_logarithms(const std::vector<std::pair<double, double>> &points) {
  LogFit fit;
  fit.n = static_cast<std::int64_t>(points.size());
  const auto n = static_cast<double>(points.size());
  double mx = 0.0, my = 0.0;
  for (const auto &[x, y] : points) {
    mx += std::log10(x) / n;
    my += std::log10(y) / n;
  }
  double xx = 0.0, xy = 0.0, dd = 0.0;
  for (const auto &[x, y] : points) {
    const double u = std::log10(x) - mx, v = std::log10(y) - my;
    xx += u * u;
    xy += u * v;
    dd += (v - u) * (v - u);
  }
  if (points.size() < 3 || !(xx > 1e-12 * n))
    throw std::runtime_error(fmt::format(
        "{} ruptures for a fit, expected at least 3 of different sizes", points.size()));
  fit.slope = xy / xx;
  fit.intercept = my - fit.slope * mx;
  double rest = 0.0;
  for (const auto &[x, y] : points) {
    const double off = std::log10(y) - fit.intercept - fit.slope * std::log10(x);
    rest += off * off;
  }
  fit.scatter = std::sqrt(rest / n);
  fit.slope_error = std::sqrt(rest / (n - 2.0) / xx);
  fit.ratio = std::pow(10.0, my - mx);
  fit.ratio_scatter = std::sqrt(dd / n);
  return fit;
}

std::vector<bool> slips_by_itself(const std::vector<Event> &events) {
  std::vector<std::size_t> order(events.size());
  double longest = 0.0;
  for (std::size_t k = 0; k < events.size(); ++k) {
    order[k] = k;
    longest = std::max(longest, events[k].t_end - events[k].t_start);
  }
  std::sort(order.begin(), order.end(), [&events](std::size_t a, std::size_t b) {
    return events[a].t_start < events[b].t_start;
  });
  std::vector<bool> alone(events.size());
  std::size_t first = 0;
  for (const std::size_t k : order) {
    const Event &e = events[k];
    while (events[order[first]].t_start < e.t_start - longest) ++first;
    double others = 0.0;
    for (std::size_t m = first; m < order.size() && events[order[m]].t_start < e.t_end; ++m)
      if (order[m] != k && events[order[m]].t_end > e.t_start)
        others += std::fabs(events[order[m]].slip_moment);
    alone[k] = others < 0.1 * std::fabs(e.slip_moment);
  }
  return alone;
}

std::vector<LogBin> rupture_densities(const EventTable &table, RuptureQuantity quantity) {
  Extent times;
  for (const Event &e : table.events) {
    times.add(e.t_start);
    times.add(e.t_end);
  }
  const double unit = (times.hi - times.lo) * table.length();
  if (times.empty() || !(unit > 0.0)) return {};
  std::vector<LogBin> bins;
  if (quantity == RuptureQuantity::length) {
    double bin = 1.0;
    if (const std::string *text = table.info.find("slip_bin")) text_io::parse(*text, bin);
    if (!(bin > 0.0))
      throw std::runtime_error(table.path + ": slip_bin in the header is not positive");
    bins = length_bins(table, bin);
  } else {
    bins = LogHistogram(column(table.events, &Event::slip_moment)).bins();
  }
  for (LogBin &bin : bins) {
    const double width = unit * (bin.hi - bin.lo);
    bin.density = static_cast<double>(bin.count) / width;
    bin.error = std::sqrt(static_cast<double>(bin.count)) / width;
  }
  return bins;
}

}  // namespace LSM::postproc
