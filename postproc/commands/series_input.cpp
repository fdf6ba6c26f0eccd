// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_input.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "input_file.h"

namespace LSM::postproc {

void SeriesOptions::add_to(CLI::App *command, bool window) {
  command->add_flag("--lenient", lenient,
                    "Drop a truncated last sample, as a killed run leaves it, and report this on "
                    "standard error; without it that is an error. Anything else wrong in a series "
                    "always is: a missing sample would change what follows");
  if (!window) return;
  command->add_option("--from", from_time, "First time used (model time)")->default_str("start");
  command->add_option("--to", to_time, "Last time used (model time)")->default_str("end");
}

std::int64_t read_series(
    const std::string &path, const SeriesOptions &options,
    const std::function<void(std::int64_t step, double time, double pe)> &use) {
  if (!(options.from_time < options.to_time))
    throw std::invalid_argument(fmt::format("--from {} --to {}: expected --from before --to",
                                            options.from_time, options.to_time));
  PeSeriesReader reader(path, options.lenient, open_input);
  std::int64_t step = 0, inside = 0;
  double time = 0.0, pe = 0.0;
  while (reader.next(step, time, pe) && time <= options.to_time) {
    use(step, time, pe);
    if (time >= options.from_time) ++inside;
  }
  if (reader.torn()) fmt::print(stderr, "postproc: {}: dropped a truncated last sample: 1\n", path);
  return inside;
}

void add_picker_options(CLI::App *command, PickerOptions &options) {
  const PickerOptions::Added added =
      options.add_to(command, "Event picker (what is not given is as in the header of the series)");
  added.lambda->description(added.lambda->get_description() +
                            ". From the header of a series of every s-th step: its value to the "
                            "power s (exponential)");
}

PickerSettings picker_settings(const PickerOptions &options, const text_io::Parameters &parameters,
                               const PeSeriesInfo &info) {
  PickerSettings s;
  if (const std::string *text = text_io::find(parameters, "picker")) from_string(*text, s.reading);
  if (options.reading) from_string(*options.reading, s.reading);
  const bool exponential = s.reading == PickerReading::exponential;
  if (options.memory_time && !exponential)
    throw std::invalid_argument(fmt::format("{} with the reading '{}', expected 'exponential'",
                                            options.time_name(), to_string(s.reading)));
  // Of every stride-th sample the memory is as long in steps.
  const std::string *lambda = text_io::find(parameters, "lambda");
  if (lambda && text_io::parse(*lambda, s.lambda) && exponential && info.stride > 1)
    s.lambda = std::pow(s.lambda, static_cast<double>(info.stride));
  if (!options.says_lambda() && !(s.lambda >= 0.0 && s.lambda < 1.0))
    throw std::invalid_argument(fmt::format(
        "lambda in the header of the series is {}, expected at least 0 and less than 1", s.lambda));
  if (const std::string *text = text_io::find(parameters, "min_size"))
    text_io::parse(*text, s.min_size);
  const std::string *keep = text_io::find(parameters, "keep_nonpositive");
  s.keep_nonpositive = keep && *keep == "yes";
  return options.over(s, info.dt * static_cast<double>(info.stride));
}

}  // namespace LSM::postproc
