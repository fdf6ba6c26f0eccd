// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "numbers.h"
#include "plot.h"
#include "regime.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

struct Options {
  std::string series, title;
  SeriesOptions samples;
  PickerOptions picker;
  PictureOptions picture;
  std::int64_t columns = 2000;
  double window = regime_window;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Values = std::array<double, 3>;  // PE, change, smoothed change

/// Thins curves to at most two rows for each column of the picture: the smallest and the largest
/// value in it, in the order in which they came, so that short drops stay visible.
class Thinner {
 public:
  Thinner(Table &table, std::int64_t samples, std::int64_t columns)
      : table_(table), samples_(samples), columns_(columns) {}

  void add(double time, const Values &values) {
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

  void end_column() {
    if (in_column_ == 0) return;
    for (int row = 0; row < (in_column_ > 1 ? 2 : 1); ++row) {
      table_.add(row == 0 ? first_time_ : last_time_);
      for (const Extremes &e : extremes_)
        table_.add(e.range.empty() ? nan : (row == 0) == e.rising ? e.range.lo : e.range.hi);
      table_.end_row();
    }
    extremes_ = {};
    in_column_ = 0;
  }

  std::array<Extent, 3> ranges;  ///< of all samples

 private:
  struct Extremes {
    Extent range;
    bool rising = true;
  };
  Table &table_;
  std::int64_t samples_, columns_, count_ = 0, column_ = -1, in_column_ = 0;
  double first_time_ = 0.0, last_time_ = 0.0;
  std::array<Extremes, 3> extremes_;
};

/// gnuplot's range of an axis with some room around the values.
std::string roomy(Extent range) {
  const double middle = 0.5 * (range.lo + range.hi);
  double half = 0.56 * (range.hi - range.lo);
  if (!(half > 0.0)) half = middle == 0.0 ? 1.0 : 0.1 * std::fabs(middle);
  return fmt::format("[{}:{}]", text_io::number(middle - half), text_io::number(middle + half));
}

std::string script(const std::string &title, const std::array<Extent, 3> &ranges, double t0,
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
                           to_string(picker.reading), short_number(picker.lambda, 6))));
}

void run(const Options &options) {
  options.picture.check({options.series}, {"-events.csv"});
  const PeSeriesInfo info = PeSeriesReader(options.series, options.samples.lenient).info();
  EventPicker picker(options.picker.settings(info.parameters, info));

  Extent times;
  const std::int64_t samples =
      read_series(options.series, options.samples, [&](std::int64_t, double time, double) {
        if (time >= options.samples.from_time) times.add(time);
      });
  if (samples < 3)
    throw std::runtime_error(fmt::format(
        "{}: {} samples in the window of time, expected at least 3", options.series, samples));

  Figure figure{Table({"time", "pe", "change", "smoothed"}), {}, {1000, 900}};
  Table events({"t_start", "t_end", "pe_start", "pe_end", "size"});
  const std::string settings = fmt::format(
      "picker: {}, lambda = {}", to_string(picker.settings().reading), picker.settings().lambda);
  figure.table.comment("PE series of model " + info.model + ", model units; " + settings);
  if (samples > 2 * options.columns)
    figure.table.comment(
        fmt::format("{} samples thinned: smallest and largest values in each of {} "
                    "columns, in the order in which they came",
                    samples, options.columns));
  events.comment("events picked in the window; an empty size: not ended yet; " + settings);

  RegimeMeter meter(options.window, info.dt * static_cast<double>(info.stride), length_of(info));
  Thinner thinner(figure.table, samples, options.columns);
  const auto add_event = [&](double t_start, double t_end, double pe_start, double pe_end,
                             double size) {
    events.add(t_start).add(t_end).add(pe_start).add(pe_end).add(size).end_row();
  };
  double before = nan;
  Event event;
  SeriesOptions again = options.samples;
  again.to_time = times.hi;
  read_series(options.series, again, [&](std::int64_t step, double time, double pe) {
    if (picker.push(step, time, pe, event) && event.t_end >= times.lo) {
      add_event(event.t_start, event.t_end, event.pe_start, event.pe_end, event.size);
      meter.event(std::max(event.t_start, times.lo), event.t_end);
    }
    if (time >= times.lo) {
      meter.add(pe);
      const bool first = std::isnan(before);
      thinner.add(time, {pe, pe - before, first ? nan : picker.rate()});
    }
    before = pe;
  });
  thinner.end_column();
  if (picker.in_event()) {
    const PickerState &state = picker.state();
    add_event(state.t_start, times.hi, state.pe_start, before, nan);
  }

  const std::string title = options.title.empty()
                                ? fmt::format("{} events, time {} to {}", events.rows(),
                                              short_number(times.lo, 7), short_number(times.hi, 7))
                                : options.title;
  figure.script =
      script(title, thinner.ranges, times.lo, times.hi, events.rows() > 0, picker.settings());
  events.write(options.picture.output + "-events.csv");
  fmt::print("{} samples, {} events\nwrote {}-events.csv\n", samples, events.rows(),
             options.picture.output);
  fmt::print("{}\n", regime_line(meter));
  make(figure, options.picture);
}

}  // namespace

void add_series(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "series",
      "Draws a PE series with the events picked from it: PE with the sizes of the events, its "
      "change per sample with the smoothed change, the smoothed change (paper: Figs. 8, 11; 9; "
      "10). Writes BASE.csv (the curves as drawn) and BASE-events.csv, too");
  auto options = std::make_shared<Options>();
  command
      ->add_option("series", options->series,
                   "PE series, text or binary, written by compute lsm/events or slider_cli")
      ->required();
  options->samples.add_to(command, true);
  command->add_option("--title", options->title, "Title of the picture")
      ->default_str("number of events and times");
  command
      ->add_option("--columns", options->columns,
                   "Columns of the picture (ours). More than twice as many samples are thinned to "
                   "the smallest and largest value in each column")
      ->check(CLI::Range(std::int64_t{10}, std::int64_t{1000000}));
  command
      ->add_option("--window", options->window,
                   "Time over which the rise and the fall of PE are measured for the number that tells stick-slip "
                   "from creep (model time, ours)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  options->picture.add_to(command, "series");
  options->picker.add_to(command);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
