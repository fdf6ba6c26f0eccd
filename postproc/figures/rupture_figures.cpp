// SPDX-License-Identifier: GPL-2.0-or-later
#include "rupture_figures.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

/// A fit in words; in a legend there is less room.
std::string short_text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}: slope {}", what, with_error(fit.slope, fit.slope_error, " ± "));
}
std::string text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}, scatter {} decades (n = {})", short_text_of(fit, what),
                     short_number(fit.scatter, 2), fit.n);
}
std::string ratio_text_of(const LogFit &fit, const std::string &what) {
  return fmt::format("{}; if proportional: ratio {}, scatter {} decades", text_of(fit, what),
                     short_number(fit.ratio, 3), short_number(fit.ratio_scatter, 2));
}

void add_line(Curves &plot, const LogFit &fit, const std::string &colour, const std::string &what) {
  plot.add(Curves::laws,
           fmt::format("10**({} + {} * log10(x)) with lines lc rgb '{}' lw 1.6 dt 1",
                       text_io::number(fit.intercept), text_io::number(fit.slope), colour),
           short_text_of(fit, what));
}

/// A scatter of one curve per catalogue, from the columns 4 and 5 of the table. The curves are
/// drawn in turns, a fifth of each at a time, so that none hides the others.
void add_scatter(Curves &plot, const RuptureRelations &relations) {
  const std::vector<RuptureScatter> &all = relations.catalogues;
  const std::size_t layers = all.size() > 1 ? 5 : 1;
  for (std::size_t layer = 0; layer < layers; ++layer)
    for (std::size_t k = 1; k <= all.size(); ++k)
      plot.add(Curves::data,
               fmt::format("table every {}::{} using (row({})):5 with points lt {} ps 0.6*point",
                           layers, layer, k, (k - 1) % 16 + 1));
  for (std::size_t k = 0; k < all.size(); ++k)
    plot.add(Curves::data, fmt::format("keyentry with points lt {}", k % 16 + 1),
             fmt::format("{} ({} ruptures{})", all[k].label, all[k].ruptures,
                         all[k].one_of == 1 ? std::string()
                                            : fmt::format(", shown: the largest {} and one of {}",
                                                          RuptureScatter::largest, all[k].one_of)));
}

/// A row for each rupture that is shown: which of which catalogue it is, and what use adds.
template <class Use>
void add_rows(Table &table, const RuptureRelations &relations, const Use &use) {
  std::int64_t number = 0;
  for (const RuptureScatter &one : relations.catalogues) {
    ++number;
    for (const RupturePoint &point : one.shown)
      use(table.add(number).add(one.label).add(point.event_id), point);
  }
}

void add_limit(Curves &plot, double limit, const Extent &heights) {
  const std::string style = "lc rgb '#777777' lw 1.6 dt (6,4)";
  plot.add(Curves::laws,
           fmt::format("'+' using ({}):({}):(0):({}) every ::::0 with vectors nohead {}",
                       text_io::number(limit), text_io::number(heights.lo),
                       text_io::number(heights.hi - heights.lo), style));
  plot.add(Curves::laws, "keyentry with lines " + style,
           "detection limit: one bin in one interval");
}

}  // namespace

Figure rupture_density_figure(const std::vector<RuptureDensity> &densities,
                              RuptureQuantity quantity, double limit) {
  const bool length = quantity == RuptureQuantity::length;
  Table table("curve,length,bin_lo,bin_hi,centre,count,density,error,label");
  table.comment(
      fmt::format("Ruptures per unit of model time, length of the fault and {}; errors: Poisson",
                  length ? "length of the rupture" : "slip moment"));
  Curves plot("$5", "$6 > 0");
  Extent values, heights;
  std::int64_t number = 0;
  for (const RuptureDensity &density : densities) {
    if (density.bins.empty()) continue;
    ++number;
    std::int64_t count = 0;
    for (const LogBin &bin : density.bins) {
      table.add(number).add(density.fault);
      add_bin(table, bin);
      table.row(density.label);
      count += bin.count;
      if (bin.count == 0) continue;
      values.add(bin.centre);
      heights.add(bin.density);
    }
    plot.add_data(number, 7, 8, fmt::format("{} ({} ruptures)", density.label, count));
  }
  if (number == 0) throw std::runtime_error("no ruptures in any catalogue, nothing to draw");
  if (limit > values.lo) {
    add_limit(plot, limit, heights);
    table.comment(fmt::format("detection limit, one bin in one interval: {}", limit));
  }
  return plot.figure(
      std::move(table),
      axis("x", length ? "Length of the rupture (model units)" : "Slip moment (model units)", true,
           values.lo, values.hi) +
          axis("y",
               length ? "Ruptures per time, fault length and length"
                      : "Ruptures per time, fault length and moment",
               true, heights.lo, heights.hi));
}

Figure moment_length_figure(const RuptureRelations &relations) {
  Table table("catalogue,label,event_id,length,moment,whole_fault");
  table.comment(
      "Ruptures: slip moment (shear modulus x slip x length) against length; "
      "whole_fault: 1 where the whole fault slipped");
  add_rows(table, relations, [](Table &row, const RupturePoint &point) {
    row.row(point.length, point.moment, point.whole_fault);
  });
  const LogFit &fit = relations.moment_of_length;
  table.comment(text_of(fit, "fit, without those of the whole fault"));
  Curves plot("$4");
  add_scatter(plot, relations);
  add_line(plot, fit, "#000000", "fit, whole fault excluded");
  plot.add(Curves::laws,
           fmt::format("{} * x**2 with lines lc rgb '#777777' dt (4,4)",
                       text_io::number(std::pow(10.0, fit.intercept + fit.slope * 1.0) / 100.0)),
           "slope 2: constant stress drop");
  return plot.figure(std::move(table), axis("x", "Length of the rupture (model units)", true,
                                            relations.lengths.lo, relations.lengths.hi) +
                                           axis("y", "Slip moment (model units)", true,
                                                relations.moments.lo, relations.moments.hi));
}

Figure moment_pe_figure(const RuptureRelations &relations) {
  Table table("catalogue,label,event_id,moment,pe_drop,alone");
  table.comment(
      "Ruptures: drop of the total PE from beginning to end against slip moment; alone: 1 if the "
      "others at the same time have less than a tenth of its moment");
  add_rows(table, relations, [](Table &row, const RupturePoint &point) {
    row.row(point.moment, point.pe_drop, point.alone);
  });
  const LogFit &all = relations.pe_of_moment, &alone = relations.pe_of_moment_alone;
  table.comment(fmt::format("PE rose during {} of {} ruptures, which are not drawn",
                            relations.pe_rose, relations.pe_rose + all.n));
  table.comment(ratio_text_of(all, "fit of all"));
  Curves plot("$4");
  add_scatter(plot, relations);
  plot.add(Curves::laws,
           "table using ($6 == 1 && $5 > 0 ? $4 : NaN):5 with points pt 6 ps 1.5*point lc rgb "
           "'#000000'",
           "isolated in time");
  add_line(plot, all, "#777777", "all");
  const bool any_alone = alone.n >= 3;
  if (any_alone) {
    table.comment(ratio_text_of(alone, "fit of those isolated in time"));
    add_line(plot, alone, "#000000", "isolated");
  }
  const double ratio = any_alone ? alone.ratio : all.ratio;
  plot.add(Curves::laws, text_io::number(ratio) + " * x with lines lc rgb '#D55E00' dt (6,4)",
           fmt::format("proportional: {} x moment", short_number(ratio, 2)));
  return plot.figure(std::move(table), axis("x", "Slip moment (model units)", true,
                                            relations.pe_moments.lo, relations.pe_moments.hi) +
                                           axis("y", "Drop of the total PE (model units)", true,
                                                relations.pe_drops.lo, relations.pe_drops.hi));
}

Figure stress_drop_figure(const RuptureRelations &relations) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Table table("catalogue,label,event_id,moment,stress_drop,mean,error");
  table.comment(
      "Ruptures: mean stress drop against slip moment. Rows without event_id: means "
      "over two bins of the moment per decade, with their standard errors");
  Curves plot("$4");
  plot.add(Curves::areas, "0 with lines lt 8 lw 0.6");
  add_scatter(plot, relations);
  std::int64_t number = 0;
  for (const RuptureScatter &one : relations.catalogues) {
    ++number;
    for (const RupturePoint &point : one.shown)
      table.row(number, one.label, point.event_id, point.moment, point.stress_drop, nan, nan);
    for (const StressMean &mean : one.means)
      table.row(number, one.label, nan, mean.moment, nan, mean.mean, mean.error);
    plot.add(Curves::laws,
             fmt::format("table using ($6 == $6 ? row({}) : NaN):6 with lines lt 8 lw 1.6", number),
             number == 1 ? "means of half decades" : "");
    plot.add(Curves::laws,
             fmt::format("table using (row({})):($6-$7):(0):(2*$7) with vectors nohead lt 8 lw 1.2",
                         number));
  }
  Extent drops = relations.stress_drops;
  drops.add(0.0);
  const double room = 0.05 * (drops.hi - drops.lo);
  return plot.figure(
      std::move(table),
      axis("x", "Slip moment (model units)", true, relations.moments.lo, relations.moments.hi) +
          axis("y", "Mean stress drop (model units)", false, drops.lo - room, drops.hi + room));
}

}  // namespace LSM::postproc
