// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_image.h
/// Slip history of a run reduced to the size of a page: slip velocity in space and time, with one
/// byte per cell.
#ifndef LSM_POSTPROC_SLIP_IMAGE_H
#define LSM_POSTPROC_SLIP_IMAGE_H

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "files/slip_history.h"

namespace LSM::postproc {
/// Image of a slip history.

struct SlipImage {
  static constexpr int steps = 127;
  /// Slip velocity over the driving velocity that byte k stands for; byte -k stands for backward
  /// slip. Velocities increase in equal ratios of 16 % from a hundredth on; byte 0 stands for
  /// anything slower.
  std::array<double, steps + 1> velocity{};

  SlipHistoryInfo info;
  int columns = 0;          ///< number of cells along the fault
  int bins_per_column = 1;  ///< bins of the history per column; the last may have fewer
  int records_per_row = 1;  ///< records of the history per row; the last may have fewer
  double begin = 0.0;       ///< model time at which the first row begins
  /// Model time at which each row ends and the next one begins.
  std::vector<double> ends;
  std::vector<std::int8_t> cells;  ///< row by row
};

/// Reduces the part of a history between two times. Bins and records are averaged until there are
/// at most `most_columns` columns and about `most_cells` cells. While a cell slips, the rounding
/// error of its byte is carried over to the next row, so that the slip of an event, summed over its
/// rows, is right to a few per cent of its last row.
/// \param from, to model times
/// \throws FileError if the history cannot be read
/// \throws std::runtime_error if it is of a plane, or there is no record between these times
SlipImage slip_image(SlipHistoryReader &reader,
                     double from = -std::numeric_limits<double>::infinity(),
                     double to = std::numeric_limits<double>::infinity(), int most_columns = 240,
                     std::int64_t most_cells = 8'000'000);

}  // namespace LSM::postproc

#endif
