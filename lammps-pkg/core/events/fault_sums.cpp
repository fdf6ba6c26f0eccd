// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/fault_sums.h"

#include <algorithm>
#include <cmath>

#include "numerics/circular_mean.h"
#include "numerics/constants.h"

namespace LSM {

MeanPlace::MeanPlace(const FaultAxis &axis) : axis_(axis) {
  const double circle = 2.0 * pi / axis.bins;
  for (int b = 0; b < axis.bins; ++b) {
    cosine_.push_back(axis.ring ? std::cos(circle * (b + 0.5)) : b + 0.5);
    sine_.push_back(axis.ring ? std::sin(circle * (b + 0.5)) : 1.0);
  }
}

double MeanPlace::of(double cosines, double sines) const {
  if (axis_.ring) return axis_.begin + part_of_ring(sines, cosines) * axis_.length();
  return axis_.begin + (sines > 0.0 ? cosines / sines / axis_.bins : 0.0) * axis_.length();
}

namespace {

/// Fills the places of an axis without a value.
/// \param occupied places that have one, in order
/// \param at returns the value of a place
template <class At>
void interpolate(const FaultAxis &axis, const std::vector<std::size_t> &occupied, const At &at) {
  if (occupied.empty()) return;
  const auto bins = static_cast<std::size_t>(axis.bins);
  if (!axis.ring) {
    for (std::size_t b = 0; b < occupied.front(); ++b) at(b) = at(occupied.front());
    for (std::size_t b = occupied.back() + 1; b < bins; ++b) at(b) = at(occupied.back());
  }
  for (std::size_t k = 0; k + (axis.ring ? 0 : 1) < occupied.size(); ++k) {
    const std::size_t left = occupied[k];
    const std::size_t right = k + 1 < occupied.size() ? occupied[k + 1] : occupied[0] + bins;
    const double a = at(left), b = at(right % bins);
    const auto distance = static_cast<double>(right - left);
    for (std::size_t open = left + 1; open < right; ++open)
      at(open % bins) = a + (b - a) * (static_cast<double>(open - left) / distance);
  }
}

}  // namespace

std::vector<double> face_displacements(const FaultGrid &grid, const double *sums, FaultField field,
                                       FaultField steps_field, std::int64_t steps) {
  const auto bins = static_cast<std::size_t>(grid.bins), rows = static_cast<std::size_t>(grid.rows);
  std::vector<double> mean(bins * rows, 0.0);
  std::vector<std::size_t> occupied_rows;  // with particles
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::size_t> occupied;  // bins with particles
    for (std::size_t b = 0; b < bins; ++b) {
      const double *const s = sums + fields_of(grid) * (b * rows + row);
      if (!(s[steps_field] > 0.0)) continue;
      mean[b * rows + row] = s[field] / s[steps_field] * static_cast<double>(steps);
      occupied.push_back(b);
    }
    interpolate(grid.strike(), occupied,
                [&](std::size_t b) -> double & { return mean[b * rows + row]; });
    if (!occupied.empty()) occupied_rows.push_back(row);
  }
  if (occupied_rows.size() < rows)
    for (std::size_t b = 0; b < bins; ++b)
      interpolate(grid.dip(), occupied_rows,
                  [&](std::size_t row) -> double & { return mean[b * rows + row]; });
  return mean;
}

FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps) {
  FaultRow row(grid);
  const auto all = [&](FaultField upper, FaultField lower, FaultField force,
                       std::size_t component) {
    const std::vector<double> above = face_displacements(grid, sums, upper, UPPER_STEPS, steps),
                              below = face_displacements(grid, sums, lower, LOWER_STEPS, steps);
    for (std::size_t b = 0; b < row.work.size(); ++b) {
      const double *const s = sums + fields_of(grid) * b;
      const std::size_t n = grid.components() * b + component;
      row.slip[n] = static_cast<float>(above[b] - below[b]);
      row.work[b] = static_cast<float>(s[WORK]);
      row.stress[n] = static_cast<float>(s[force] / (static_cast<double>(steps) * grid.area()));
    }
  };
  all(UPPER, LOWER, FORCE, 0);
  if (grid.plane) all(UPPER_DIP, LOWER_DIP, FORCE_DIP, 1);
  return row;
}

}  // namespace LSM
