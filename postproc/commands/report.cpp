// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "input_file.h"
#include "new_file.h"
#include "numbers.h"
#include "option_values.h"
#include "report.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  ReportSettings report;
  std::string output = "report.html", block = "auto";
  std::vector<std::string> series;
};

/// Reads a PE series once; events are picked with the settings of its header.
SeriesRegime series_regime(const std::string &path, const SeriesOptions &options) {
  const PeSeriesInfo info = PeSeriesReader(path, options.lenient, open_input).info();
  SeriesRegime result;
  result.path = path;
  result.model = info.model;
  for (const char *const key : {"length", "blocks"})
    if (const std::string *text = info.find(key)) text_io::parse(*text, result.length);
  EventPicker picker(picker_settings({}, info.parameters, info));
  RegimeMeter meter(regime_window, info.dt * static_cast<double>(info.stride), length_of(info));
  Event event;
  Extent times;
  const std::int64_t samples =
      read_series(path, options, [&](std::int64_t step, double time, double pe) {
        const bool picked = picker.push(step, time, pe, event);
        if (time < options.from_time) return;
        times.add(time);
        meter.add(pe);
        if (picked) meter.event(std::max(event.t_start, times.lo), event.t_end);
      });
  if (samples < 3)
    throw std::runtime_error(
        fmt::format("{}: {} samples in the window of time, expected at least 3", path, samples));
  result.first = times.lo;
  result.last = times.hi;
  try {
    result.regime = meter.result();
  } catch (const std::runtime_error &error) {
    result.why = error.what();
  }
  return result;
}

}  // namespace

void add_report(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "report",
      "One self-contained HTML page about a set of catalogues: parameters, counts, figures (SVG), "
      "fits, finite-size scaling, Table 1, and which of it is the paper's and which is ours");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  ReportSettings &report = options->report;
  command->add_option("-o,--output", options->output, "The page");
  command->add_option("--title", report.title, "Heading of the page");
  add_threshold(command, report.threshold, "the events");
  command
      ->add_option("--replicas", report.replicas,
                   "Synthetic samples of the Monte Carlo p-values of fitted sizes; 0: none")
      ->check(zero_or_more());
  command
      ->add_option("--interval-replicas", report.interval_replicas,
                   "Synthetic samples of the Monte Carlo p-values of fitted inter-event times; 0: "
                   "none")
      ->check(zero_or_more());
  command
      ->add_option("--bootstrap", report.bootstrap.replicas,
                   "Resampled catalogues for the errors of the characteristic sizes")
      ->check(CLI::Range(2, 1000000));
  command->add_option("--block", options->block, block_help);
  add_seed(command, report.seed);
  command
      ->add_option("--series", options->series,
                   "PE series whose regime, stick-slip or creep, the page shall state (ours), "
                   "several allowed; --from, --to and --lenient hold for them, too")
      ->type_name("FILE")
      ->default_str("")
      ->allow_extra_args(false);
  command->callback([options] {
    refuse_input(options->output, options->catalogues.paths);
    refuse_input(options->output, options->series);
    options->report.bootstrap.block = parse_block(options->block);
    const std::vector<EventTable> tables = load_catalogues(options->catalogues);
    SeriesOptions samples;
    samples.lenient = options->catalogues.lenient;
    samples.from_time = options->catalogues.from_time;
    samples.to_time = options->catalogues.to_time;
    std::vector<SeriesRegime> series;
    for (const std::string &path : options->series) series.push_back(series_regime(path, samples));
    write_file(options->output, report_html(tables, options->report, series));
    fmt::print("wrote {}\n", options->output);
  });
}

}  // namespace LSM::postproc
