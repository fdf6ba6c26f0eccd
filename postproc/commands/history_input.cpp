// SPDX-License-Identifier: GPL-2.0-or-later
#include "history_input.h"

#include <fmt/format.h>

#include "input_file.h"

namespace LSM::postproc {

SlipHistoryReader open_history(const std::string &path, bool lenient) {
  SlipHistoryReader reader(open_input(path), lenient);
  if (reader.torn()) fmt::print(stderr, "postproc: {}: dropped a truncated last record: 1\n", path);
  if (!(reader.info().driving > 0.0))
    throw std::runtime_error(path + ": the driving velocity in the header is not positive");
  return reader;
}

}  // namespace LSM::postproc
