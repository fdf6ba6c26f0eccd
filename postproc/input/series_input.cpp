// SPDX-License-Identifier: GPL-2.0-or-later
#include "series_input.h"

#include <stdexcept>

#include <fmt/format.h>

#include "event_table.h"
#include "input_file.h"

namespace LSM::postproc {

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

}  // namespace LSM::postproc
