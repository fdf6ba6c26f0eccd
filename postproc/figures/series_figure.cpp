// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lsm_text_io.h"

namespace LSM::postproc {

void Thinner::add(double time, const Values &values) {
  // Few samples are drawn one by one.
  const double part = static_cast<double>(count_) / static_cast<double>(samples_);
  const auto column = samples_ <= 2 * columns_
                          ? count_
                          : static_cast<std::int64_t>(part * static_cast<double>(columns_));
  if (column != column_) end_column();
  column_ = column;
  if (in_column_++ == 0) first_time_ = time;
  last_time_ = time;
  ++count_;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) continue;
    Extremes &e = extremes_[k];
    // The later of the two is the one that was exceeded last.
    if (values[k] > e.range.hi) e.rising = true;
    if (values[k] < e.range.lo) e.rising = false;
    e.range.add(values[k]);
    ranges[k].add(values[k]);
  }
}

void Thinner::end_column() {
  if (in_column_ == 0) return;
  for (int row = 0; row < (in_column_ > 1 ? 2 : 1); ++row) {
    table_.add(row == 0 ? first_time_ : last_time_);
    for (const Extremes &e : extremes_)
      table_.add(e.range.empty() ? std::nan("") : (row == 0) == e.rising ? e.range.lo : e.range.hi);
    table_.end_row();
  }
  extremes_ = {};
  in_column_ = 0;
}

namespace {

/// gnuplot's range of an axis with some room around the values.
std::string roomy(Extent range) {
  const double middle = 0.5 * (range.lo + range.hi);
  double half = 0.56 * (range.hi - range.lo);
  if (!(half > 0.0)) half = middle == 0.0 ? 1.0 : 0.1 * std::fabs(middle);
  return fmt::format("[{}:{}]", text_io::number(middle - half), text_io::number(middle + half));
}

}  // namespace

std::string series_script(const std::string &title, const std::array<Extent, 3> &ranges, double t0,
                          double t1, bool events, const PickerSettings &picker) {
  // Rounded ticks hide small changes on a large offset: show the distance from the lowest value.
  const Extent pe = ranges[0];
  const bool shifted = pe.hi - pe.lo < 0.01 * std::max(std::fabs(pe.hi), std::fabs(pe.lo));
  const double shift = shifted ? pe.lo : 0.0;
  // Arrows too short to see would only hide the curve.
  const double shortest = 0.01 * (pe.hi - pe.lo);
  const std::string shade = events ? "events using 1:(0):1:2:(-1e300):(1e300) with boxxyerror fs "
                                     "solid 1.0 noborder lc rgb '#cccccc' "
                                   : "";
  const auto shaded = [&](const std::string &name) {
    return events ? shade + name + ", \\\n     " : std::string();
  };
  Extent change = ranges[1], smoothed = ranges[2];
  for (Extent *range : {&change, &smoothed}) range->add(0.0);

  return fmt::format(
      R"(events = base."-events.csv"
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
)",
      fmt::arg("title", quote(title)), fmt::arg("t0", text_io::number(t0)),
      fmt::arg("t1", text_io::number(t1)),
      fmt::arg("pe_label",
               shifted ? fmt::format("'PE - {}'", short_number(shift, 8)) : "'Potential energy'"),
      fmt::arg("pe_range", roomy({pe.lo - shift, pe.hi - shift})),
      fmt::arg("events_named", shaded("title 'event'")),
      fmt::arg("events_plain", shaded("notitle")), fmt::arg("shift", text_io::number(shift)),
      fmt::arg("arrows",
               events
                   ? fmt::format(", \\\n     events using 2:($3 - {}):(0):($5 > {} ? -$5 : NaN) "
                                 "with vectors head filled size screen 0.005,18 lw 1.2 dt 1 lc rgb "
                                 "'#D55E00' title 'size of the event'",
                                 text_io::number(shift), text_io::number(shortest))
                   : ""),
      fmt::arg("change_range", roomy(change)), fmt::arg("smoothed_range", roomy(smoothed)),
      fmt::arg("smoothed_label",
               fmt::format("'smoothed ({}, {{/Symbol l}} = {}); an event where negative'",
                           to_string(picker.reading), short_number(picker.lambda, 3))));
}

}  // namespace LSM::postproc
