// SPDX-License-Identifier: GPL-2.0-or-later
/// \file thinner.h
/// Long series for pictures: what a column of pixels can show.
#ifndef LSM_POSTPROC_THINNER_H
#define LSM_POSTPROC_THINNER_H

#include <array>
#include <cstdint>
#include <vector>

#include "samples.h"

namespace LSM::postproc {

/// Thins three curves in one pass, however long they are: up to 2 x columns samples are kept one by
/// one; of more, groups of equally many, from columns to 2 x columns of them, keep their smallest
/// and largest values in the order in which they came, so that short drops stay visible.
class Thinner {
 public:
  using Values = std::array<double, 3>;
  struct Row {
    double time;
    Values values;  ///< NaN: none
  };

  explicit Thinner(std::int64_t columns) : most_(2 * static_cast<std::size_t>(columns)) {}

  void add(double time, const Values &values);
  std::vector<Row> rows() const;
  std::int64_t groups() const { return static_cast<std::int64_t>(groups_.size()); }
  bool thinned() const { return in_each_ > 1; }
  Extent range(std::size_t curve) const;  ///< of all samples

 private:
  struct Extremes {
    Extent range;
    bool rising = true;  ///< the largest came after the smallest
    void add(const Extremes &later);
  };
  struct Group {
    double first, last;  ///< times
    std::array<Extremes, 3> extremes;
    void add(const Group &later);
  };

  std::size_t most_;
  std::int64_t in_each_ = 1, in_last_ = 0;
  std::vector<Group> groups_;
};

/// Places of the values that are left of a long series: of groups of neighbours the smallest and
/// the largest, in their order, so that there are at most `most`.
std::vector<std::size_t> smallest_and_largest(const std::vector<double> &values, std::size_t most);

}  // namespace LSM::postproc

#endif
