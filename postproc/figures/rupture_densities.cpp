// SPDX-License-Identifier: GPL-2.0-or-later
#include "rupture_densities.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

// Lengths in bins of the fault from lo to hi - 1, as wide as ten bins a decade where that is more
// than one.
std::vector<LogBin> length_bins(const RuptureTable &table, double bin) {
  std::map<std::int64_t, std::int64_t> counts;
  for (const Event &e : table.events)
    ++counts[std::max<std::int64_t>(1, std::llround(e.rupture_length / bin))];
  std::vector<LogBin> bins;
  for (std::int64_t lo = 1; !counts.empty() && lo <= counts.rbegin()->first;) {
    const std::int64_t hi =
        std::max(lo + 1, static_cast<std::int64_t>(
                             std::llround(LogHistogram::default_factor * static_cast<double>(lo))));
    LogBin one{};
    // Between the whole numbers.
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

/// Moment of a rupture of one bin that slips as slowly as counts for one interval: modulus, slip
/// velocity, time and width; 0 if the header does not say them all.
double smallest_moment(const CatalogueInfo &info) {
  double moment = 1.0;
  for (const char *const key : {"modulus", "slip_velocity", "interval", "dt", "slip_bin"}) {
    const std::string *const text = info.find(key);
    double value = 0.0;
    if (!text || !text_io::parse(*text, value) || !(value > 0.0)) return 0.0;
    moment *= value;
  }
  return moment;
}

}  // namespace

std::vector<LogBin> rupture_densities(const RuptureTable &table, RuptureQuantity quantity) {
  Extent times;
  for (const Event &e : table.events) {
    times.add(e.t_start);
    times.add(e.t_end);
  }
  const double unit = (times.hi - times.lo) * table.head.length();
  if (times.empty() || !(unit > 0.0)) return {};
  std::vector<LogBin> bins;
  if (quantity == RuptureQuantity::length) {
    double bin = 1.0;
    if (const std::string *text = table.head.info.find("slip_bin")) text_io::parse(*text, bin);
    if (!(bin > 0.0))
      throw std::runtime_error(table.head.path + ": slip_bin in the header is not positive");
    bins = length_bins(table, bin);
  } else {
    LogHistogram histogram;
    for (const Event &e : table.events) histogram.add(e.slip_moment);
    bins = histogram.bins();
  }
  for (LogBin &bin : bins) {
    const double width = unit * (bin.hi - bin.lo);
    bin.density = static_cast<double>(bin.count) / width;
    bin.error = std::sqrt(static_cast<double>(bin.count)) / width;
  }
  return bins;
}

Figure rupture_density_figure(const std::vector<RuptureTable> &tables, RuptureQuantity quantity) {
  const bool length = quantity == RuptureQuantity::length;
  Figure figure{Table({"curve", "length", "bin_lo", "bin_hi", "centre", "count", "density", "error",
                       "label"}),
                {},
                {}};
  figure.table.comment(
      fmt::format("Ruptures per unit of model time, length of the fault and {}; "
                  "errors: Poisson",
                  length ? "length of the rupture" : "slip moment"));
  Extent values, heights;
  std::string plots;
  std::vector<std::string> titles;
  std::int64_t number = 0;
  for (const RuptureTable &table : tables) {
    const std::vector<LogBin> bins = rupture_densities(table, quantity);
    if (bins.empty()) continue;
    ++number;
    std::int64_t count = 0;
    for (const LogBin &bin : bins) {
      figure.table.add(number).add(table.head.length());
      add_bin(figure.table, bin);
      figure.table.add(table.head.label).end_row();
      count += bin.count;
      if (bin.count == 0) continue;
      values.add(bin.centre);
      heights.add(bin.density);
    }
    titles.push_back(fmt::format("{} ({} ruptures)", table.head.label, count));
    const std::string row = fmt::format("row({})", number);
    plots += fmt::format("{0}{1}, \\\n     table using ({2}):7 with points lt {3} title {4}",
                         plots.empty() ? "plot " : ", \\\n     ",
                         error_bars(row, "$7", "$8", number), row, number, quote(titles.back()));
  }
  if (number == 0) throw std::runtime_error("no ruptures in any catalogue, nothing to draw");
  const double limit = length ? 0.0 : smallest_moment(tables.front().head.info);
  if (limit > values.lo) {
    plots += fmt::format(
        ", \\\n     '+' using ({0}):({1}):(0):({2}) every ::::0 with vectors nohead lc rgb "
        "'#777777' lw 1.6 dt (6,4) notitle, \\\n     keyentry with lines lc rgb '#777777' lw 1.6 "
        "dt "
        "(6,4) title 'detection limit: one bin in one interval'",
        text_io::number(limit), text_io::number(heights.lo),
        text_io::number(heights.hi - heights.lo));
    titles.emplace_back("detection limit: one bin in one interval");
    figure.table.comment(fmt::format("detection limit, one bin in one interval: {}", limit));
  }
  figure.size = size_with_key(titles);
  figure.script =
      axis("x", length ? "Length of the rupture (model units)" : "Slip moment (model units)", true,
           values.lo, values.hi) +
      axis("y",
           length ? "Ruptures per time, fault length and length"
                  : "Ruptures per time, fault length and moment",
           true, heights.lo, heights.hi) +
      "row(k) = $1 == k && $6 > 0 ? $5 : NaN\n" + std::string(error_bar_function) + plots + "\n";
  return figure;
}

}  // namespace LSM::postproc
