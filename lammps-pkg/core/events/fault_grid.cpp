// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/fault_grid.h"

#include <algorithm>
#include <cmath>

#include "numerics/circular_mean.h"
#include "numerics/constants.h"

namespace LSM {

double FaultGrid::time(std::int64_t step) const {
  return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
}

bool FaultGrid::ends_interval(std::int64_t step) const {
  return step > step0 && (step - step0) % interval == 0;
}

MeanPlace::MeanPlace(const FaultGrid &grid) : grid_(grid) {
  const double circle = 2.0 * pi / grid.bins;
  for (int b = 0; b < grid.bins; ++b) {
    cosine_.push_back(grid.ring ? std::cos(circle * (b + 0.5)) : b + 0.5);
    sine_.push_back(grid.ring ? std::sin(circle * (b + 0.5)) : 1.0);
  }
}

double MeanPlace::of(double cosines, double sines) const {
  if (grid_.ring) return grid_.x0 + part_of_ring(sines, cosines) * grid_.length();
  return grid_.x0 + (sines > 0.0 ? cosines / sines / grid_.bins : 0.0) * grid_.length();
}

std::vector<double> face_displacements(const FaultGrid &grid, const double *sums,
                                       std::int64_t steps) {
  const auto bins = static_cast<std::size_t>(grid.bins);
  std::vector<double> mean(bins, 0.0);
  std::vector<std::size_t> occupied;  // bins with particles
  for (std::size_t b = 0; b < bins; ++b) {
    const double *const s = sums + fault_fields * b;
    if (!(s[1] > 0.0)) continue;
    mean[b] = s[0] / s[1] * static_cast<double>(steps);
    occupied.push_back(b);
  }
  if (occupied.empty()) return mean;
  if (!grid.ring) {
    std::fill(mean.begin(), mean.begin() + static_cast<std::ptrdiff_t>(occupied.front()),
              mean[occupied.front()]);
    std::fill(mean.begin() + static_cast<std::ptrdiff_t>(occupied.back()), mean.end(),
              mean[occupied.back()]);
  }
  for (std::size_t k = 0; k + (grid.ring ? 0 : 1) < occupied.size(); ++k) {
    const std::size_t left = occupied[k];
    const std::size_t right = k + 1 < occupied.size() ? occupied[k + 1] : occupied[0] + bins;
    const double a = mean[left], b = mean[right % bins];
    const auto distance = static_cast<double>(right - left);
    for (std::size_t open = left + 1; open < right; ++open)
      mean[open % bins] = a + (b - a) * (static_cast<double>(open - left) / distance);
  }
  return mean;
}

FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps) {
  FaultRow row(grid.bins);
  const std::vector<double> upper = face_displacements(grid, sums + UPPER, steps),
                            lower = face_displacements(grid, sums + LOWER, steps);
  for (std::size_t b = 0; b < row.slip.size(); ++b) {
    const double *const s = sums + fault_fields * b;
    row.slip[b] = static_cast<float>(upper[b] - lower[b]);
    row.work[b] = static_cast<float>(s[WORK]);
    row.stress[b] = static_cast<float>(s[FORCE] / (static_cast<double>(steps) * grid.width));
  }
  return row;
}

double slipping_above(const FaultGrid &grid, double velocity) { return velocity * grid.duration(); }

}  // namespace LSM
