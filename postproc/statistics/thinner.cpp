// SPDX-License-Identifier: GPL-2.0-or-later
#include "thinner.h"

#include <algorithm>
#include <cmath>

namespace LSM::postproc {

void Thinner::Extremes::add(const Extremes &later) {
  const bool higher = later.range.hi > range.hi, lower = later.range.lo < range.lo;
  if (higher != lower) rising = higher;
  if (higher && lower) rising = later.rising;
  if (later.range.empty()) return;
  range.add(later.range.lo);
  range.add(later.range.hi);
}

void Thinner::Group::add(const Group &later) {
  last = later.last;
  for (std::size_t k = 0; k < extremes.size(); ++k) extremes[k].add(later.extremes[k]);
}

void Thinner::add(double time, const Values &values) {
  Group one{time, time, {}};
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isnan(values[k])) one.extremes[k].range.add(values[k]);
  if (in_last_ > 0 && in_last_ < in_each_) {
    groups_.back().add(one);
    ++in_last_;
    return;
  }
  if (groups_.size() == most_) {
    for (std::size_t k = 0; 2 * k + 1 < most_; ++k) {
      groups_[2 * k].add(groups_[2 * k + 1]);
      groups_[k] = groups_[2 * k];
    }
    groups_.resize(most_ / 2);
    in_each_ *= 2;
  }
  groups_.push_back(one);
  in_last_ = 1;
}

std::vector<Thinner::Row> Thinner::rows() const {
  std::vector<Row> out;
  for (const Group &group : groups_)
    for (const bool begin : {true, false}) {
      if (!begin && group.last == group.first) continue;
      Row row{begin ? group.first : group.last, {}};
      for (std::size_t k = 0; k < row.values.size(); ++k) {
        const auto &[range, rising] = group.extremes[k];
        row.values[k] = range.empty() ? std::nan("") : begin == rising ? range.lo : range.hi;
      }
      out.push_back(row);
    }
  return out;
}

Range Thinner::range(std::size_t curve) const {
  Extremes all;
  for (const Group &group : groups_) all.add(group.extremes[curve]);
  return all.range;
}

std::vector<std::size_t> smallest_and_largest(const std::vector<double> &values, std::size_t most) {
  const std::size_t n = values.size(), group = (2 * n + most - 1) / most;
  std::vector<std::size_t> kept;
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t begin = 0; begin < n; begin += group) {
    const auto [low, high] = std::minmax_element(at(begin), at(std::min(begin + group, n)));
    const auto [first, second] = std::minmax(low, high);
    kept.push_back(static_cast<std::size_t>(first - values.begin()));
    if (second != first) kept.push_back(static_cast<std::size_t>(second - values.begin()));
  }
  return kept;
}

}  // namespace LSM::postproc
