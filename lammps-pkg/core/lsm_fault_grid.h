// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_fault_grid.h
/// A fault in bins along it and in intervals of so many steps: what its contacts did in each.
///
/// Values of a bin and interval are kept as floats: the slip history has the numbers that the
/// events were found from, and sums over several ranks, which differ in the order of the additions,
/// give the same numbers.
#ifndef LSM_FAULT_GRID_H
#define LSM_FAULT_GRID_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace LSM {

/// How the fault is divided, and the times of the intervals.
struct FaultGrid {
  int bins = 1;
  double x0 = 0.0;            ///< lower edge of the first bin
  double width = 1.0;         ///< of a bin; the fault has the length bins * width
  std::int64_t step0 = 0;     ///< begin of the first interval
  std::int64_t interval = 1;  ///< steps
  double time0 = 0.0;         ///< time at step0
  double dt = 1.0;            ///< time of a step
  bool ring = true;           ///< periodic; else the fault has two ends

  double length() const { return bins * width; }
  double duration() const { return static_cast<double>(interval) * dt; }  ///< of an interval
  double time(std::int64_t step) const {
    return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
  }
  bool ends_interval(std::int64_t step) const {
    return step > step0 && (step - step0) % interval == 0;
  }
  double centre(std::int64_t bin) const { return x0 + (static_cast<double>(bin) + 0.5) * width; }
};

/// What the bins of the fault did in one interval. Slip and stress are positive in the direction in
/// which the fault is driven.
struct FaultRow {
  std::vector<float> slip;    ///< mean slip of the contacts along the fault
  std::vector<float> work;    ///< work lost to friction
  std::vector<float> stress;  ///< shear force of the contacts per length, mean over the interval
  FaultRow() = default;
  explicit FaultRow(int bins)
      : slip(static_cast<std::size_t>(bins)), work(slip.size()), stress(slip.size()) {}
};

/// Sums of the contacts of a bin over an interval, see SlipRecorder: slip, contacts, work, force.
constexpr std::size_t fault_fields = 4;

/// The row of an interval of so many steps from SlipRecorder::sums(). The slip of a bin without
/// contacts is interpolated linearly between the nearest two with contacts (periodic).
inline FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps) {
  FaultRow row(grid.bins);
  const auto bins = static_cast<std::size_t>(grid.bins);
  const auto count = static_cast<double>(steps);
  std::vector<std::size_t> held;  // bins with contacts
  for (std::size_t b = 0; b < bins; ++b) {
    const double *const s = sums + fault_fields * b;
    row.work[b] = static_cast<float>(s[2]);
    row.stress[b] = static_cast<float>(s[3] / (count * grid.width));
    if (!(s[1] > 0.0)) continue;
    row.slip[b] = static_cast<float>(s[0] / s[1] * count);
    held.push_back(b);
  }
  if (held.empty()) return row;
  if (!grid.ring) {
    std::fill(row.slip.begin(), row.slip.begin() + static_cast<std::ptrdiff_t>(held.front()),
              row.slip[held.front()]);
    std::fill(row.slip.begin() + static_cast<std::ptrdiff_t>(held.back()), row.slip.end(),
              row.slip[held.back()]);
  }
  for (std::size_t k = 0; k + (grid.ring ? 0 : 1) < held.size(); ++k) {
    const std::size_t left = held[k];
    const std::size_t right = k + 1 < held.size() ? held[k + 1] : held[0] + bins;
    const double a = row.slip[left], b = row.slip[right % bins];
    const auto distance = static_cast<double>(right - left);
    for (std::size_t open = left + 1; open < right; ++open)
      row.slip[open % bins] =
          static_cast<float>(a + (b - a) * (static_cast<double>(open - left) / distance));
  }
  return row;
}

/// What slips and what is connected; part of a slip history.
struct RuptureSettings {
  double velocity = 0.0;    ///< bins whose slip velocity exceeds this slip
  int gap = 0;              ///< bins that may lie between two that are connected
  std::int64_t memory = 1;  ///< intervals over which bins are connected, at least 1
  double modulus = 1.0;     ///< shear modulus
};

/// Displacement of a bin in an interval above which it slips; the same wherever ruptures are found.
inline double slipping_above(const FaultGrid &grid, double velocity) {
  return velocity * grid.duration();
}

}  // namespace LSM

#endif
