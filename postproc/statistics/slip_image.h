// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_image.h
/// The slip history of a run small enough for a page: slip velocity in space and time, a byte for
/// each cell.
#ifndef LSM_POSTPROC_SLIP_IMAGE_H
#define LSM_POSTPROC_SLIP_IMAGE_H

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "files/slip_history.h"

namespace LSM::postproc {

struct SlipImage {
  static constexpr int steps = 127;
  /// Slip velocity over the driving velocity that byte k stands for, byte -k for slip backwards;
  /// from a hundredth on in equal ratios of 16 %. velocity[0] is 0: less than that.
  std::array<double, steps + 1> velocity{};

  SlipHistoryInfo info;
  int columns = 0;                 ///< cells along the fault
  int bins_per_column = 1;         ///< bins of the history; the last column may have fewer
  int records_per_row = 1;         ///< records of the history; the last row may have fewer
  double begin = 0.0;              ///< model time at which the first row begins
  std::vector<double> ends;        ///< model time at which each row ends, and the next one begins
  std::vector<std::int8_t> cells;  ///< row by row
};

/// The part of a history from one time to another. Bins and records are joined, by their mean,
/// until there are at most `most_columns` columns and about `most_cells` cells. While a cell slips,
/// what the byte of one row leaves over is taken into the next, so that the slip of an event,
/// summed over its rows, is right to a few per cent of its last row.
/// \throws FileError; std::runtime_error without records
SlipImage slip_image(SlipHistoryReader &reader,
                     double from = -std::numeric_limits<double>::infinity(),
                     double to = std::numeric_limits<double>::infinity(), int most_columns = 240,
                     std::int64_t most_cells = 8'000'000);

}  // namespace LSM::postproc

#endif
