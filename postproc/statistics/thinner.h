// SPDX-License-Identifier: GPL-2.0-or-later
/// \file thinner.h
/// Reduces long series to what the columns of pixels of a picture can show.
#ifndef LSM_POSTPROC_THINNER_H
#define LSM_POSTPROC_THINNER_H

#include <array>
#include <cstdint>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Thins three curves in one pass, whatever their length. Up to 2 x columns samples are kept as
/// they are; beyond that, samples are merged into between columns and 2 x columns groups of equal
/// size. Each group keeps its smallest and largest value in the order in which they came, so that
/// short drops remain visible.
class Thinner {
 public:
  using Values = std::array<double, 3>;
  struct Row {
    double time;
    Values values;  ///< NaN: no value
  };

  explicit Thinner(std::int64_t columns) : most_(2 * static_cast<std::size_t>(columns)) {}

  /// Adds the next sample.
  void add(double time, const Values &values);
  /// Samples to draw: up to two for each group, at its first and last time.
  std::vector<Row> rows() const;
  std::int64_t groups() const { return static_cast<std::int64_t>(groups_.size()); }
  bool thinned() const { return in_each_ > 1; }
  /// Range of all samples of a curve.
  Range range(std::size_t curve) const;

 private:
  struct Extremes {
    Range range;
    bool rising = true;  ///< whether the largest value came after the smallest
    void add(const Extremes &later);
  };
  struct Group {
    double first, last;  ///< times of the first and the last sample
    std::array<Extremes, 3> extremes;
    void add(const Group &later);
  };

  std::size_t most_;
  std::int64_t in_each_ = 1, in_last_ = 0;
  std::vector<Group> groups_;
};

/// Thins a series to the smallest and the largest value of each group of neighbours.
/// \return indices of the values kept, at most `most` of them, in ascending order
std::vector<std::size_t> smallest_and_largest(const std::vector<double> &values, std::size_t most);

}  // namespace LSM::postproc

#endif
