// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "commands.h"
#include "input_file.h"
#include "json_output.h"
#include "lsm_catalogue.h"
#include "new_file.h"
#include "option_values.h"
#include "series_input.h"

namespace LSM::postproc {

namespace {

struct Options {
  std::string series, output;
  SeriesOptions samples;
  JsonOutput json;
  PickerOptions picker;
  std::optional<double> warmup, completeness;
  bool force = false;
};

void set(text_io::Parameters &parameters, const std::string &key, const std::string &value) {
  for (auto &parameter : parameters) {
    if (parameter.first != key) continue;
    parameter.second = value;
    return;
  }
  parameters.emplace_back(key, value);
}

/// The header that the run itself writes: the parameters of the series with dt among them, and the
/// picker's settings. A value that has not changed keeps its text.
text_io::Parameters catalogue_parameters(const PeSeriesInfo &info, const PickerSettings &picker,
                                         double warmup, std::optional<double> completeness) {
  text_io::Parameters parameters = info.parameters;
  // Where the runs have it: the fault before its viscosity, the block-slider before its picker.
  const auto after_dt =
      std::find_if(parameters.begin(), parameters.end(), [](const auto &parameter) {
        return parameter.first == "viscosity" || parameter.first == "picker";
      });
  parameters.insert(after_dt, {"dt", info.model == "lsm" ? text_io::number(info.dt)
                                                         : fmt::format("{}", info.dt)});
  set(parameters, "picker", to_string(picker.reading));
  const auto set_number = [&parameters](const std::string &key, double value) {
    double there = 0.0;
    const std::string *text = text_io::find(parameters, key);
    if (!text || !text_io::parse(*text, there) || there != value)
      set(parameters, key, fmt::format("{}", value));
  };
  set_number("lambda", picker.lambda);
  set_number("min_size", picker.min_size);
  if (picker.keep_nonpositive || text_io::find(parameters, "keep_nonpositive"))
    set(parameters, "keep_nonpositive", picker.keep_nonpositive ? "yes" : "no");
  if (warmup > 0.0 || text_io::find(parameters, "warmup")) set_number("warmup", warmup);
  if (completeness) set_number("completeness", *completeness);
  if (info.stride > 1) set(parameters, "stride", text_io::number(info.stride));
  set(parameters, "picked_by", "postproc " POSTPROC_VERSION);
  return parameters;
}

void run(Options &options) {
  options.json.check({options.series});
  check_outputs({{"--output", options.output}, options.json.output()}, {options.series});
  const PeSeriesInfo info =
      PeSeriesReader(options.series, options.samples.lenient, open_input).info();
  EventPicker picker(picker_settings(options.picker, info.parameters, info));
  double warmup = 0.0;
  if (const std::string *text = info.find("warmup")) text_io::parse(*text, warmup);
  if (options.warmup) warmup = *options.warmup;

  CatalogueInfo header;
  header.model = info.model;
  header.parameters = catalogue_parameters(info, picker.settings(), warmup, options.completeness);
  for (const auto &[key, value] : header.parameters)
    if (const std::string problem = catalogue_detail::bad_value(key, value); !problem.empty())
      throw std::invalid_argument(options.series + ": " + problem);
  const FileLock lock = claim_output(options.output, options.force);
  CatalogueWriter catalogue;
  catalogue.create(options.output, header, true);
  std::int64_t early = 0;
  Event event;
  const std::int64_t samples =
      read_series(options.series, options.samples, [&](std::int64_t step, double time, double pe) {
        if (!picker.push(step, time, pe, event)) return;
        if (event.t_start < warmup) {
          ++early;
          return;
        }
        event.id = catalogue.rows() + 1;
        catalogue.write(event);
      });
  catalogue.close();
  fmt::print(
      "{} samples, {} events; not written: {} of size <= 0, {} below the minimum size, {} "
      "before the warm-up ended{}\nwrote {}\n",
      samples, catalogue.rows(), picker.dropped_nonpositive(), picker.dropped_small(), early,
      picker.in_event() ? ", 1 that had not ended" : "", options.output);
  Table counts({"samples", "events", "nonpositive", "small", "before_warmup", "unfinished"});
  counts.add(samples).add(catalogue.rows()).add(picker.dropped_nonpositive());
  counts.add(picker.dropped_small()).add(early).add(std::int64_t{picker.in_event()}).end_row();
  options.json.add("counts", counts);
  options.json.write();
}

}  // namespace

void add_pick(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "pick",
      "Picks the events of a PE series and writes their catalogue (paper: Sect. 4.1). The rows are "
      "those that the run itself writes under the same settings, less the columns about slip, "
      "which a PE series does not tell. One pass, whatever the length of the series");
  auto options = std::make_shared<Options>();
  command
      ->add_option("series", options->series,
                   "PE series, text or binary, written by compute lsm/events or slider_cli")
      ->required();
  command->add_option("-o,--output", options->output, "Catalogue to write")->required();
  command->add_flag("--force", options->force, "Replace the catalogue if it exists");
  options->samples.add_to(command, false);
  options->json.add_to(command);
  command->add_option(
      "--warmup", options->warmup,
      "Leave out events that start before this time (model time; ours; default: as in "
      "the header of the series, or 0)");
  command
      ->add_option(
          "--completeness", options->completeness,
          "Size below which the events are not claimed to be independent of the time step "
          "(energy; ours), for the header of the catalogue: the other commands begin there "
          "by default (default: as in the header of the series, or not said)")
      ->check(zero_or_more());
  add_picker_options(command, options->picker);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
