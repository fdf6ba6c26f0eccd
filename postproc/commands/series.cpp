// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "command.h"
#include "numbers.h"
#include "series_figures.h"
#include "series_options.h"

namespace LSM::postproc {

namespace {

class Series : public Analysis {
  std::string series_, title_;
  SeriesOptions samples_;
  PickerOptions picker_;
  std::int64_t columns_ = 2000;

  const char *help() const override {
    return "Draws a PE series with the events picked from it, its change per sample and the "
           "smoothed change (paper: Figs. 8 to 11). Writes BASE.csv (the curves as drawn) and BASE-events.csv, too";
  }

  void add_options(CLI::App *command) override {
    OptionGroup group(command);
    add_series(group, series_, samples_, true);
    json.add_to(command);
    group.add("--title", title_, "Title of the picture", shown("number of events and times"));
    group.add("--columns", columns_,
              "Columns of the picture †, in each of which many samples are thinned to the smallest "
              "and largest",
              between(std::int64_t{10}, std::int64_t{1000000}));
    add_picture(command, "series");
    add_picker_options(command, picker_);
  }

  std::vector<std::string> inputs() const override { return {series_}; }
  std::vector<std::string> endings() const override { return {"-events.csv"}; }

  /// Everything that is needed from the series, collected in one pass.
  struct Samples {
    explicit Samples(std::int64_t columns) : curves(columns) {}
    std::int64_t count = 0, picked = 0;  // samples and events in the window
    Range times;
    Thinner curves;
    Table events{"t_start,t_end,pe_start,pe_end,size"};
    std::string model;
    PickerSettings picker;
  };

  Samples read() const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    SeriesInput series(series_, samples_);
    EventPicker picker(picker_settings(picker_, series.info()));
    EventFilter filter(filter_settings(picker_, series.info()));
    Samples out(columns_);
    out.picker = picker.settings();
    Range &times = out.times;
    double before = nan;
    Event event;
    out.model = series.info().model;
    out.count = series.read_some([&](std::int64_t step, double time, double pe) {
      if (!is_before(time, samples_.from_time)) times.add(time);
      if (picker.push(step, time, pe, event) && filter.passes(event) && event.t_end >= times.lo)
        out.events.row(event.t_start, event.t_end, event.pe_start, event.pe_end, event.size);
      if (!times.empty())
        out.curves.add(time, {pe, pe - before, std::isnan(before) ? nan : picker.rate()});
      before = pe;
    });
    out.picked = out.events.rows();
    if (picker.in_event())
      out.events.row(picker.state().t_start, times.hi, picker.state().pe_start, before, nan);
    return out;
  }

  Results find() override {
    Samples samples = read();
    const Range &times = samples.times;
    std::string title = title_;
    if (title.empty())
      title = fmt::format("{} events, time {} to {}", samples.picked, short_number(times.lo, 7),
                          short_number(times.hi, 7));
    Figure figure = series_figure(samples.curves, title, times.lo, times.hi, samples.picked > 0,
                                  samples.picker);
    const std::string settings = fmt::format(
        "picker: {}, lambda = {}", to_string(samples.picker.reading), samples.picker.lambda);
    figure.table.comment("PE series of model " + samples.model + ", model units; " + settings);
    if (samples.curves.thinned())
      figure.table.comment(
          fmt::format("{} samples thinned: smallest and largest values in each of {} columns, in "
                      "order of time",
                      samples.count, samples.curves.groups()));
    samples.events.comment("events picked in the window; empty size: not ended yet; " + settings);
    Results results;
    results.say(fmt::format("{}: {} samples, {} events, time {} to {}\n", series_, samples.count,
                            samples.picked, short_number(times.lo, 7), short_number(times.hi, 7)));
    Table counts("samples,events,first,last");
    counts.row(samples.count, samples.picked, times.lo, times.hi);
    results.table("series", std::move(counts));
    results.table("events", std::move(samples.events), "-events");
    results.figure("", std::move(figure));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_series() { return std::make_shared<Series>(); }

}  // namespace LSM::postproc
