// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_figures.h"

#include <algorithm>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

/// gnuplot range of an axis, with some space around the values.
std::string roomy(Range range) {
  const double middle = 0.5 * (range.lo + range.hi);
  double half = 0.56 * (range.hi - range.lo);
  if (!(half > 0.0)) half = middle == 0.0 ? 1.0 : 0.1 * std::fabs(middle);
  return fmt::format("[{}:{}]", text::number(middle - half), text::number(middle + half));
}

constexpr const char *panels = R"(events = base."-events.csv"
set multiplot layout 3,1 title {title} margins char 15, char 3, char 5, char 4 spacing char 0, char 3
set key at graph 1,1.02 right bottom horizontal samplen 2 spacing 1 width 1 maxcols 4 noreverse Right
unset grid
set xrange [{t0}:{t1}]
set format y '%.3g'
set format x ''
set xlabel ''
set ylabel {pe_label} offset -1,0
set yrange {pe_range}
plot {events_named}table using 1:($2 - {shift}) with lines lt 1 lw 1.2 title 'potential energy'{arrows}
set ylabel 'Change per sample' offset -1,0
set yrange {change_range}
plot {events_plain}0 with lines lt 8 lw 0.6 notitle, \
     table using 1:3 with lines lt 1 lw 0.8 title 'change', \
     table using 1:4 with lines lt 2 dt 1 lw 1.4 title 'smoothed'
set format x '%.6g'
set xlabel 'Time (model units)'
set ylabel 'Smoothed change' offset -1,0
set yrange {smoothed_range}
plot {events_plain}0 with lines lt 8 lw 0.6 notitle, \
     table using 1:4 with lines lt 2 dt 1 lw 1.2 title {smoothed_label}
unset multiplot
)";

}  // namespace

Figure series_figure(const Thinner &curves, const std::string &title, double t0, double t1,
                     bool events, const PickerSettings &picker) {
  Table table("time,pe,change,smoothed");
  for (const Thinner::Row &row : curves.rows())
    table.row(row.time, row.values[0], row.values[1], row.values[2]);
  // Labels of ticks are rounded, which would hide small changes on a large offset. Then the
  // distance from the lowest value is drawn.
  const Range pe = curves.range(0);
  const bool shifted = pe.hi - pe.lo < 0.01 * std::max(std::fabs(pe.hi), std::fabs(pe.lo));
  const double shift = shifted ? pe.lo : 0.0;
  // Arrows that are too short to be seen would only hide the curve.
  const double shortest = 0.01 * (pe.hi - pe.lo);
  const std::string shade = events ? "events using 1:(0):1:2:(-1e300):(1e300) with boxxyerror fs "
                                     "solid 1.0 noborder lc rgb '#cccccc' {}, \\\n     "
                                   : "";
  const std::string arrows =
      events ? fmt::format(
                   ", \\\n     events using 2:($3 - {}):(0):($5 > {} ? -$5 : NaN) with "
                   "vectors head filled size screen 0.005,18 lw 1.2 dt 1 lc rgb '#D55E00' "
                   "title 'size of the event'",
                   text::number(shift), text::number(shortest))
             : "";
  Range change = curves.range(1), smoothed = curves.range(2);
  for (Range *range : {&change, &smoothed}) range->add(0.0);
  return {std::move(table),
          fmt::format(
              panels, fmt::arg("title", quote(title)), fmt::arg("t0", text::number(t0)),
              fmt::arg("t1", text::number(t1)),
              fmt::arg("pe_label", shifted ? fmt::format("'PE - {}'", short_number(shift, 8))
                                           : "'Potential energy'"),
              fmt::arg("pe_range", roomy({pe.lo - shift, pe.hi - shift})),
              fmt::arg("events_named", fmt::format(fmt::runtime(shade), "title 'event'")),
              fmt::arg("events_plain", fmt::format(fmt::runtime(shade), "notitle")),
              fmt::arg("shift", text::number(shift)), fmt::arg("arrows", arrows),
              fmt::arg("change_range", roomy(change)), fmt::arg("smoothed_range", roomy(smoothed)),
              fmt::arg("smoothed_label",
                       fmt::format("'smoothed ({}, {{/Symbol l}} = {}); an event where negative'",
                                   to_string(picker.reading), short_number(picker.lambda, 3)))),
          {1000, 900}};
}

}  // namespace LSM::postproc
