// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "numbers.h"
#include "regime.h"
#include "series_figure.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One row; without a regime its numbers are empty. \param line the same as text
Table regime_table(std::int64_t samples, std::int64_t events, const RegimeMeter &meter,
                   std::string &line) {
  Table table(
      "samples,events,regime,saw_tooth,stick_slip_above,drop_over_load,"
      "time_in_events,mean_duration,why");
  try {
    const Regime r = meter.result();
    table.row(samples, events, name_of(r), r.saw_tooth, r.above, r.drop_over_load, r.time_in_events,
              r.mean_duration, "");
    line = fmt::format(
        "{} (saw-tooth {}; above {} is stick-slip, ours), fastest fall / load {}, time in events "
        "{}, mean duration {}",
        name_of(r), short_number(r.saw_tooth), short_number(r.above, 3),
        short_number(r.drop_over_load), short_number(r.time_in_events),
        short_number(r.mean_duration));
  } catch (const std::runtime_error &e) {
    line = e.what();
    table.row(samples, events, "", nan, nan, nan, nan, nan, line);
  }
  return table;
}

class Series : public Analysis {
  std::string series_, title_;
  SeriesOptions samples_;
  PickerOptions picker_;
  std::int64_t columns_ = 2000;
  double window_ = regime_window;

  const char *help() const override {
    return "Draws a PE series with the events picked from it: PE with the sizes of the events, its "
           "change per sample with the smoothed change, the smoothed change (paper: Figs. 8, 11; "
           "9; 10). Writes BASE.csv (the curves as drawn) and BASE-events.csv, too";
  }

  void add_options(CLI::App *command) override {
    OptionGroup group(command);
    add_series(group, series_);
    samples_.add_to(group, true);
    json.add_to(command);
    group.add("--title", title_, "Title of the picture", shown("number of events and times"));
    group.add("--columns", columns_,
              "Columns of the picture (ours). More than twice as many samples are thinned to the "
              "smallest and largest value in each column",
              between(std::int64_t{10}, std::int64_t{1000000}));
    group.add("--window", window_,
              "Time over which the rise and the fall of PE are measured for the saw-tooth "
              "number, which distinguishes stick-slip from creep (model time, ours)",
              positive());
    add_picture(command, "series");
    add_picker_options(command, picker_);
  }

  std::vector<std::string> inputs() const override { return {series_}; }
  std::vector<std::string> endings() const override { return {"-events.csv"}; }

  Findings find() override {
    // Read twice: how many samples there are decides which of them are drawn.
    SeriesOptions window = samples_;
    Extent times;
    const std::int64_t samples =
        SeriesInput(series_, window).read_some([&](std::int64_t, double time, double) {
          if (time >= window.from_time) times.add(time);
        });
    window.to_time = times.hi;
    SeriesInput series(series_, window);
    const PeSeriesInfo &info = series.info();
    EventPicker picker(picker_settings(picker_, info));

    Figure figure{Table("time,pe,change,smoothed"), {}, {1000, 900}};
    Table events("t_start,t_end,pe_start,pe_end,size");
    const std::string settings = fmt::format(
        "picker: {}, lambda = {}", to_string(picker.settings().reading), picker.settings().lambda);
    figure.table.comment("PE series of model " + info.model + ", model units; " + settings);
    if (samples > 2 * columns_)
      figure.table.comment(
          fmt::format("{} samples thinned: smallest and largest values in each of {} columns, in "
                      "order of time",
                      samples, columns_));
    events.comment("events picked in the window; empty size: not ended yet; " + settings);

    RegimeMeter meter(window_, series.spacing(), length_of(info));
    Thinner thinner(figure.table, samples, columns_);
    double before = nan;
    Event event;
    series.read([&](std::int64_t step, double time, double pe) {
      if (picker.push(step, time, pe, event) && event.t_end >= times.lo) {
        events.row(event.t_start, event.t_end, event.pe_start, event.pe_end, event.size);
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
    if (picker.in_event())
      events.row(picker.state().t_start, times.hi, picker.state().pe_start, before, nan);

    std::string title = title_;
    if (title.empty())
      title = fmt::format("{} events, time {} to {}", events.rows(), short_number(times.lo, 7),
                          short_number(times.hi, 7));
    figure.script = series_script(title, thinner.ranges, times.lo, times.hi, events.rows() > 0,
                                  picker.settings());
    Findings found;
    std::string regime;
    found.say(fmt::format("{} samples, {} events\n", samples, events.rows()));
    found.numbers("series", regime_table(samples, events.rows(), meter, regime));
    found.table("events", std::move(events), "-events");
    found.say("regime: " + regime + "\n");
    found.figure("", std::move(figure));
    return found;
  }
};

}  // namespace

std::shared_ptr<Command> make_series() { return std::make_shared<Series>(); }

}  // namespace LSM::postproc
