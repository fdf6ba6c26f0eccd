// SPDX-License-Identifier: GPL-2.0-or-later
#include "ruptures.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "files/text.h"

namespace LSM::postproc {

namespace {

// Counts the lengths in whole bins of the fault, lo to hi - 1 of them in one bin of the density,
// with ten bins per decade where these are wider than one bin of the fault.
std::vector<LogBin> length_bins(const EventTable &table, double bin) {
  std::map<std::int64_t, std::int64_t> counts;
  for (const Event &e : table.details)
    ++counts[std::max<std::int64_t>(1, std::llround(e.rupture_length / bin))];
  std::vector<LogBin> bins;
  for (std::int64_t lo = 1; !counts.empty() && lo <= counts.rbegin()->first;) {
    const std::int64_t hi = std::max(
        lo + 1,
        static_cast<std::int64_t>(std::llround(usual_bin_factor * static_cast<double>(lo))));
    LogBin one{};
    // edges halfway between integers
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
  std::vector<double> x, y, ratios;
  for (const auto &[one, other] : points) {
    x.push_back(std::log10(one));
    y.push_back(std::log10(other));
    ratios.push_back(y.back() - x.back());
  }
  const std::size_t count = points.size();
  const auto n = static_cast<double>(count);
  if (count < 3 || !(gsl_stats_tss(x.data(), 1, count) > 1e-12 * n))
    throw DegenerateData(
        fmt::format("{} ruptures for a fit, expected at least 3 of different sizes", count));
  LogFit fit;
  fit.n = static_cast<std::int64_t>(count);
  double rest = 0.0, variance_intercept = 0.0, covariance = 0.0, variance_slope = 0.0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, count, &fit.intercept, &fit.slope, &variance_intercept,
                 &covariance, &variance_slope, &rest);
  fit.slope_error = std::sqrt(variance_slope);
  fit.scatter = std::sqrt(rest / n);
  fit.ratio = std::pow(10.0, mean_of(ratios));
  fit.ratio_scatter = std::sqrt(gsl_stats_tss(ratios.data(), 1, count) / n);
  return fit;
}

std::vector<bool> slips_by_itself(const std::vector<Event> &events) {
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  double longest = 0.0;
  for (const Event &e : events) longest = std::max(longest, e.t_end - e.t_start);
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
  for (const Event &e : table.details) {
    times.add(e.t_start);
    times.add(e.t_end);
  }
  const double unit = (times.hi - times.lo) * table.length();
  if (times.empty() || !(unit > 0.0)) return {};
  std::vector<LogBin> bins;
  if (quantity == RuptureQuantity::length) {
    double bin = 1.0;
    if (const std::string *text = table.info.find("slip_bin")) text::parse(*text, bin);
    if (!(bin > 0.0))
      throw std::runtime_error(table.path + ": slip_bin in the header is not positive");
    bins = length_bins(table, bin);
  } else {
    bins = log_histogram(column(table.details, &Event::slip_moment));
  }
  for (LogBin &bin : bins) {
    const double width = unit * (bin.hi - bin.lo);
    bin.density = static_cast<double>(bin.count) / width;
    bin.error = std::sqrt(static_cast<double>(bin.count)) / width;
  }
  return bins;
}

double smallest_moment(const CatalogueInfo &info) {
  double moment = 1.0;
  for (const char *const key : {"modulus", "slip_velocity", "interval", "dt", "slip_bin"}) {
    const std::string *const text = info.find(key);
    double value = 0.0;
    if (!text || !text::parse(*text, value) || !(value > 0.0)) return 0.0;
    moment *= value;
  }
  double height = 0.0;  // of the cells of a plane
  const std::string *const text = info.find("slip_bin_dip");
  return text && text::parse(*text, height) ? moment * height : moment;
}

namespace {

using Pairs = std::vector<std::pair<double, double>>;

/// Mean stress drop in bins of half a decade of the moment.
class StressMeans {
 public:
  void add(const RupturePoint &point) {
    Sums &bin = bins_[std::lround(std::floor(2.0 * std::log10(point.moment)))];
    bin.n += 1.0;
    bin.y += point.stress_drop;
    bin.yy += point.stress_drop * point.stress_drop;
  }
  std::vector<StressMean> result() const {
    std::vector<StressMean> means;
    for (const auto &[bin, s] : bins_) {
      if (s.n < 3.0) continue;
      const double mean = s.y / s.n;
      means.push_back({std::pow(10.0, 0.5 * (static_cast<double>(bin) + 0.5)), mean,
                       std::sqrt(std::max(0.0, s.yy / s.n - mean * mean) / (s.n - 1.0))});
    }
    return means;
  }

 private:
  struct Sums {
    double n = 0.0, y = 0.0, yy = 0.0;
  };
  std::map<long, Sums> bins_;
};

RuptureScatter scatter_of(const EventTable &table, RuptureRelations &all, Pairs &by_length,
                          Pairs &fallen, Pairs &fallen_alone) {
  RuptureScatter out;
  out.label = table.label;
  out.ruptures = table.details.size();
  out.one_of =
      std::max<std::size_t>(1, (out.ruptures + RuptureScatter::most - 1) / RuptureScatter::most);
  const double large = out.one_of > 1 ? nth_largest(column(table.details, &Event::slip_moment),
                                                    RuptureScatter::largest)
                                      : 0.0;
  const double whole = table.length() * (1.0 - 1e-9);
  const std::vector<bool> alone = slips_by_itself(table.details);
  StressMeans means;
  for (std::size_t i = 0; i < table.details.size(); ++i) {
    const Event &e = table.details[i];
    if (!(e.slip_moment > 0.0)) continue;
    const RupturePoint point = {e.id,          e.rupture_length,      e.slip_moment,
                                e.stress_drop, e.pe_start - e.pe_end, e.rupture_length > whole,
                                alone[i]};
    if (i % out.one_of == 0 || point.moment >= large) out.shown.push_back(point);
    means.add(point);
    all.lengths.add(point.length);
    all.moments.add(point.moment);
    all.stress_drops.add(point.stress_drop);
    if (!point.whole_fault) by_length.emplace_back(point.length, point.moment);
    if (!(point.pe_drop > 0.0)) {
      ++all.pe_rose;
      continue;
    }
    all.pe_moments.add(point.moment);
    all.pe_drops.add(point.pe_drop);
    fallen.emplace_back(point.moment, point.pe_drop);
    if (point.alone) fallen_alone.push_back(fallen.back());
  }
  out.means = means.result();
  return out;
}

}  // namespace

RuptureRelations rupture_relations(const std::vector<EventTable> &tables) {
  RuptureRelations all;
  Pairs by_length, fallen, fallen_alone;
  for (const EventTable &table : tables)
    all.catalogues.push_back(scatter_of(table, all, by_length, fallen, fallen_alone));
  if (all.moments.empty()) throw DegenerateData("nothing to draw, no rupture of positive moment");
  all.moment_of_length = fit_logarithms(by_length);
  if (fallen.empty())
    throw DegenerateData("nothing to draw, no rupture of positive moment during which PE fell");
  all.pe_of_moment = fit_logarithms(fallen);
  if (fallen_alone.size() >= 3) all.pe_of_moment_alone = fit_logarithms(fallen_alone);
  return all;
}

}  // namespace LSM::postproc
