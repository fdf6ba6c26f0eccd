// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "input_file.h"
#include "json_output.h"
#include "numbers.h"
#include "picture_options.h"
#include "plot.h"
#include "regime.h"
#include "series_figure.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

struct Options {
  std::string series, title;
  SeriesOptions samples;
  JsonOutput json;
  PickerOptions picker;
  PictureOptions picture;
  std::int64_t columns = 2000;
  double window = regime_window;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One row; without a regime its numbers are empty.
Table regime_table(std::int64_t samples, std::int64_t events, const RegimeMeter &meter) {
  Table table({"samples", "events", "regime", "saw_tooth", "stick_slip_above", "drop_over_load",
               "time_in_events", "mean_duration", "why"});
  table.add(samples).add(events);
  try {
    const Regime r = meter.result();
    table.add(name_of(r)).add(r.saw_tooth).add(r.above).add(r.drop_over_load);
    table.add(r.time_in_events).add(r.mean_duration).add("").end_row();
  } catch (const std::runtime_error &e) {
    table.add("").add(nan).add(nan).add(nan).add(nan).add(nan).add(e.what()).end_row();
  }
  return table;
}

std::string regime_line(const RegimeMeter &meter) {
  try {
    const Regime r = meter.result();
    return fmt::format(
        "regime: {} (saw-tooth {}; above {} is stick-slip, ours), fastest fall / load {}, time in "
        "events {}, mean "
        "duration {}",
        name_of(r), short_number(r.saw_tooth), short_number(r.above, 3),
        short_number(r.drop_over_load), short_number(r.time_in_events),
        short_number(r.mean_duration));
  } catch (const std::runtime_error &e) {
    return fmt::format("regime: {}", e.what());
  }
}

void run(Options &options) {
  options.json.check({options.series});
  options.picture.check({options.series}, {"-events.csv"}, {options.json.output()});
  const PeSeriesInfo info =
      PeSeriesReader(options.series, options.samples.lenient, open_input).info();
  EventPicker picker(picker_settings(options.picker, info.parameters, info));

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
  figure.script = series_script(title, thinner.ranges, times.lo, times.hi, events.rows() > 0,
                                picker.settings());
  events.write(options.picture.output + "-events.csv");
  fmt::print("{} samples, {} events\nwrote {}-events.csv\n", samples, events.rows(),
             options.picture.output);
  fmt::print("{}\n", regime_line(meter));
  make(figure, options.picture);
  options.json.add("series", regime_table(samples, events.rows(), meter));
  options.json.add("events", events);
  options.json.write();
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
  options->json.add_to(command);
  command->add_option("--title", options->title, "Title of the picture")
      ->default_str("number of events and times");
  command
      ->add_option("--columns", options->columns,
                   "Columns of the picture (ours). More than twice as many samples are thinned to "
                   "the smallest and largest value in each column")
      ->check(CLI::Range(std::int64_t{10}, std::int64_t{1000000}));
  command
      ->add_option("--window", options->window,
                   "Time over which the rise and the fall of PE are measured for the number that "
                   "tells stick-slip "
                   "from creep (model time, ours)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_picture_options(command, options->picture, "series");
  add_picker_options(command, options->picker);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
