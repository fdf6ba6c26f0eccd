// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_input.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

void SeriesOptions::add_to(CLI::App *command, bool window) {
  command->add_flag("--lenient", lenient,
                    "Drop a truncated last sample, as a killed run leaves it, and say so on "
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
  PeSeriesReader reader(path, options.lenient);
  std::int64_t step = 0, inside = 0;
  double time = 0.0, pe = 0.0;
  while (reader.next(step, time, pe) && time <= options.to_time) {
    use(step, time, pe);
    if (time >= options.from_time) ++inside;
  }
  if (reader.torn()) fmt::print(stderr, "postproc: {}: dropped a truncated last sample: 1\n", path);
  return inside;
}

void PickerOptions::add_to(CLI::App *command) {
  const std::string group = "Event picker (what is not given is as in the header of the series)";
  command
      ->add_option("--picker", reading,
                   "Reading of the paper's formula for the smoothed change A of PE (x: change): "
                   "exponential, A <- lambda A + (1 - lambda) x (ours, the default); average, A <- "
                   "(x + lambda A) / (1 + lambda) (ours); literal, A <- (x + lambda A) / (1 + "
                   "lambda t) (paper, Sect. 4.1; t: index of the change)")
      ->check(CLI::IsMember({"exponential", "average", "literal"}))
      ->group(group);
  auto *by_lambda = command->add_option(
      "--lambda", lambda,
      "Leakiness per sample, 0 to less than 1 (paper, and default: 0.99). From the header of a "
      "series of every s-th step: its value to the power s (exponential)");
  by_lambda->group(group);
  auto *by_time = command->add_option("--memory-time", memory_time,
                                      "Memory of the exponential reading, lambda = exp(-interval "
                                      "of the samples / memory) (model time; ours)");
  by_time->excludes(by_lambda)->group(group);
  command
      ->add_option("--memory-steps", memory_steps,
                   "Memory of the exponential reading, lambda = 1 - 1/memory (samples, at least 1; "
                   "ours)")
      ->excludes(by_lambda)
      ->excludes(by_time)
      ->group(group);
  command
      ->add_option("--min-size", min_size,
                   "Events of smaller size are counted, not written (energy; ours, default 0)")
      ->group(group);
  command
      ->add_flag("--keep-nonpositive", keep_nonpositive,
                 "Write events of size <= 0, too, whatever --min-size is (ours); otherwise they "
                 "are counted")
      ->group(group);
}

PickerSettings PickerOptions::settings(const text_io::Parameters &parameters,
                                       const PeSeriesInfo &info) const {
  PickerSettings s;
  if (const std::string *text = text_io::find(parameters, "picker")) from_string(*text, s.reading);
  if (reading) from_string(*reading, s.reading);
  const bool exponential = s.reading == PickerReading::exponential;
  if (lambda) {
    s.lambda = *lambda;
  } else if (memory_time || memory_steps) {
    const char *const option = memory_time ? "--memory-time" : "--memory-steps";
    if (!exponential)
      throw std::invalid_argument(fmt::format("{} with the reading '{}', expected 'exponential'",
                                              option, to_string(s.reading)));
    const double memory = memory_time ? *memory_time : *memory_steps;
    if (!std::isfinite(memory) || !(memory > 0.0) || (memory_steps && memory < 1.0))
      throw std::invalid_argument(fmt::format("{} {}: expected {}", option, memory,
                                              memory_time ? "a time > 0" : "at least 1 sample"));
    s.lambda = memory_time
                   ? lambda_from_memory_time(memory, info.dt * static_cast<double>(info.stride))
                   : 1.0 - 1.0 / memory;
  } else if (const std::string *text = text_io::find(parameters, "lambda");
             text && text_io::parse(*text, s.lambda) && exponential && info.stride > 1) {
    s.lambda = std::pow(s.lambda, static_cast<double>(info.stride));
  }
  if (!(s.lambda >= 0.0 && s.lambda < 1.0))
    throw std::invalid_argument(
        fmt::format("lambda of the picker is {}, expected at least 0 and less than 1", s.lambda));
  if (const std::string *text = text_io::find(parameters, "min_size"))
    text_io::parse(*text, s.min_size);
  if (min_size) s.min_size = *min_size;
  if (!std::isfinite(s.min_size) || s.min_size < 0.0)
    throw std::invalid_argument(
        fmt::format("--min-size {}: expected a finite size of at least 0", s.min_size));
  const std::string *keep = text_io::find(parameters, "keep_nonpositive");
  s.keep_nonpositive = keep_nonpositive || (keep && *keep == "yes");
  return s;
}

}  // namespace LSM::postproc
