// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace LSM::postproc {

namespace {

/// Averages records into rows and encodes the rows as bytes.
class Rows {
 public:
  explicit Rows(SlipImage &image)
      : image_(image), slip_(static_cast<std::size_t>(image.columns)), left_over_(slip_.size()) {
    // The bytes cover eight decades, from a hundredth of the driving velocity on.
    for (int k = 1; k <= SlipImage::steps; ++k)
      image_.velocity[static_cast<std::size_t>(k)] =
          0.01 * std::pow(10.0, 8.0 * (k - 1) / (SlipImage::steps - 1));
  }

  void add(const SlipRecord &record) {
    const FaultGrid &grid = image_.info.grid;
    if (joined_ == 0) begin_ = grid.time(record.step_begin);
    for (int c = 0; c < image_.columns; ++c) {
      const int first = c * image_.bins_per_column;
      const int last = std::min(first + image_.bins_per_column, grid.bins);
      double sum = 0.0;
      for (int b = first; b < last; ++b)
        sum += static_cast<double>(record.row.slip[static_cast<std::size_t>(b)]);
      slip_[static_cast<std::size_t>(c)] += sum / (last - first);
    }
    end_ = grid.time(record.step_end);
    if (++joined_ == image_.records_per_row) end_row();
  }

  void end_row() {
    if (joined_ == 0) return;
    const double unit = (end_ - begin_) * image_.info.driving;
    for (std::size_t c = 0; c < slip_.size(); ++c) {
      image_.cells.push_back(byte_of(slip_[c] / unit, left_over_[c], unit));
      slip_[c] = 0.0;
    }
    image_.ends.push_back(end_);
    joined_ = 0;
  }

 private:
  /// \param velocity slip velocity over the driving velocity
  /// \param left_over slip not represented by earlier bytes; updated
  /// \param unit slip of the plates in the time of the row
  std::int8_t byte_of(double velocity, double &left_over, double unit) const {
    const double least = image_.velocity[1];
    if (std::fabs(velocity) < least) {
      left_over = 0.0;  // a locked place must not seem to move
      return 0;
    }
    const double wanted = velocity + left_over / unit;
    int k = 0;
    if (wanted * velocity > 0.0 && std::fabs(wanted) >= least) {
      const double decades = std::log10(std::fabs(wanted) / least);
      k = std::min(1 + static_cast<int>(std::lround(decades * (SlipImage::steps - 1) / 8.0)),
                   SlipImage::steps);
    }
    const double taken = std::copysign(image_.velocity[static_cast<std::size_t>(k)], velocity);
    left_over = (wanted - taken) * unit;
    return static_cast<std::int8_t>(velocity < 0.0 ? -k : k);
  }

  SlipImage &image_;
  std::vector<double> slip_, left_over_;
  double begin_ = 0.0, end_ = 0.0;
  int joined_ = 0;
};

}  // namespace

SlipImage slip_image(SlipHistoryReader &reader, double from, double to, int most_columns,
                     std::int64_t most_cells) {
  SlipImage image;
  image.info = reader.info();
  const FaultGrid &grid = image.info.grid;
  if (grid.plane)
    throw std::runtime_error(
        reader.path() +
        ": slip history of a plane, expected that of a line (lsm.ruptures draws maps of planes)");
  image.bins_per_column = (grid.bins + most_columns - 1) / most_columns;
  image.columns = (grid.bins + image.bins_per_column - 1) / image.bins_per_column;
  image.records_per_row = static_cast<int>(
      std::max<std::int64_t>(1, (reader.records() * image.columns + most_cells - 1) / most_cells));
  Rows rows(image);
  SlipRecord record;
  while (reader.next(record)) {
    if (record.step_end == record.step_begin || grid.time(record.step_begin) < from) continue;
    if (grid.time(record.step_end) > to) break;
    if (image.ends.empty() && image.cells.empty()) image.begin = grid.time(record.step_begin);
    rows.add(record);
  }
  rows.end_row();
  if (image.ends.empty())
    throw std::runtime_error(reader.path() + ": nothing in the window of time");
  return image;
}

}  // namespace LSM::postproc
