// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_input.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "event_table.h"
#include "input_file.h"

namespace LSM::postproc {

void SeriesOptions::add_to(OptionGroup group, bool window) {
  group.flag("--lenient", lenient,
             "Drop a truncated last sample, as a killed run leaves it, and report this on "
             "standard error; without it that is an error. Anything else wrong in a series "
             "always is an error, as a missing sample would change what follows");
  if (!window) return;
  group.add("--from", from_time, "First time used (model time)", shown("start"));
  group.add("--to", to_time, "Last time used (model time)", shown("end"));
}

void add_series(OptionGroup group, std::string &path) {
  group.add("series", path, "PE series, written by compute lsm/events or slider_cli", required());
}

SeriesInput::SeriesInput(const std::string &path, const SeriesOptions &options)
    : path_(path), options_(options), reader_(open_input(path), options.lenient) {
  if (!(options.from_time < options.to_time))
    throw std::invalid_argument(fmt::format("--from {} --to {}: expected --from before --to",
                                            options.from_time, options.to_time));
}

std::int64_t SeriesInput::read(const Use &use) {
  std::int64_t step = 0, inside = 0;
  double time = 0.0, pe = 0.0;
  while (reader_.next(step, time, pe) && !is_before(options_.to_time, time)) {
    use(step, time, pe);
    if (!is_before(time, options_.from_time)) ++inside;
  }
  if (reader_.torn())
    fmt::print(stderr, "postproc: {}: dropped a truncated last sample: 1\n", path_);
  return inside;
}

std::int64_t SeriesInput::read_some(const Use &use) {
  const std::int64_t samples = read(use);
  if (samples < 3)
    throw std::runtime_error(
        fmt::format("{}: {} samples in the window of time, expected at least 3", path_, samples));
  return samples;
}

void add_picker_options(CLI::App *command, PickerOptions &options) {
  const PickerOptions::Added added = options.add_to(
      OptionGroup(command, "Event picker (defaults are in the header of the series)"));
  more_help(
      ". From the header of a series of every s-th step: its value to the power s (exponential)")(
      *added.lambda);
}

PickerSettings picker_settings(const PickerOptions &options, const PeSeriesInfo &info) {
  PickerSettings s;
  if (const std::string *text = info.find("picker")) from_string(*text, s.reading);
  if (options.reading) from_string(*options.reading, s.reading);
  const bool exponential = s.reading == PickerReading::exponential;
  if (options.memory_time && !exponential)
    throw std::invalid_argument(fmt::format("{} with the reading '{}', expected 'exponential'",
                                            options.time_name(), to_string(s.reading)));
  // The series has only every stride-th step, and the memory has to be as long in steps.
  const std::string *lambda = info.find("lambda");
  if (lambda && text::parse(*lambda, s.lambda) && exponential && info.stride > 1)
    s.lambda = std::pow(s.lambda, static_cast<double>(info.stride));
  return options.over(s, info.dt * static_cast<double>(info.stride));
}

FilterSettings filter_settings(const PickerOptions &options, const PeSeriesInfo &info) {
  FilterSettings s;
  if (const std::string *text = info.find("min_size")) text::parse(*text, s.min_size);
  const std::string *keep = info.find("keep_nonpositive");
  s.keep_nonpositive = keep && *keep == "yes";
  return options.over(s);
}

}  // namespace LSM::postproc
