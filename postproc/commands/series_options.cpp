// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_options.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

void add_series(OptionGroup group, std::string &path, SeriesOptions &of, bool window) {
  group.add("series", path, "PE series, written by compute lsm/events or slider_cli", required());
  group.flag("--lenient", of.lenient,
             "Drop a truncated last sample, as a killed run leaves it; anything else wrong in a "
             "series always is an error");
  if (!window) return;
  group.add("--from", of.from_time, "First time used (model time)", shown("start"));
  group.add("--to", of.to_time, "Last time used (model time)", shown("end"));
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
