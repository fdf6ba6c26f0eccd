// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/fault_grid.h
/// Divides a fault into bins along it, or a plane into cells along strike and dip, and time into
/// intervals of some steps, and describes what the faces did in each.
///
/// Values of a bin and interval are kept as floats: thus the slip history has exactly the numbers
/// from which events were found, and sums over several ranks, which differ in the order of the
/// additions, give the same numbers.
#ifndef LSM_FAULT_GRID_H
#define LSM_FAULT_GRID_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace LSM {

/// Bins along one direction of a fault.
struct FaultAxis {
  int bins;
  double begin;  ///< lower edge of the first bin
  double width;  ///< of a bin
  bool ring;     ///< periodic; otherwise it has two ends

  double length() const { return bins * width; }
  double edge(std::int64_t bin) const { return begin + static_cast<double>(bin) * width; }
  double centre(std::int64_t bin) const { return begin + (static_cast<double>(bin) + 0.5) * width; }
  /// The bin at a place; that at the end for places beyond an end, or that are not finite.
  int bin(double place) const {
    double along = (place - begin) / length();
    along = ring ? along - std::floor(along) : std::max(along, 0.0);
    return static_cast<int>(std::min(bins - 1.0, along * bins));
  }
};

/// How the fault is divided, and the times of the intervals. In two dimensions it is a line along
/// x, the strike. In three it is a plane along x and z, the dip (upwards); its cells are numbered
/// along dip first. Vectors have as many components as the fault has directions.
struct FaultGrid {
  int bins = 1;
  double x0 = 0.0;            ///< lower edge of the first bin
  double width = 1.0;         ///< of a bin; the length of the fault is bins * width
  std::int64_t step0 = 0;     ///< step at which the first interval begins
  std::int64_t interval = 1;  ///< steps in an interval
  double time0 = 0.0;         ///< time at step0
  double dt = 1.0;            ///< time of a step
  bool ring = true;           ///< periodic; otherwise the fault has two ends

  bool plane = false;     ///< with what follows
  int rows = 1;           ///< bins along dip
  double z0 = 0.0;        ///< lower edge of the first row
  double height = 1.0;    ///< of a row
  bool ring_dip = false;  ///< periodic along dip

  FaultAxis strike() const { return {bins, x0, width, ring}; }
  FaultAxis dip() const { return {rows, z0, height, ring_dip}; }
  int cells() const { return bins * rows; }
  std::size_t components() const { return plane ? 2 : 1; }
  double area() const { return plane ? width * height : width; }  ///< of a cell; of a bin its width

  double length() const { return bins * width; }
  double duration() const { return static_cast<double>(interval) * dt; }  ///< of an interval
  double time(std::int64_t step) const {
    return time0 + (static_cast<double>(step) - static_cast<double>(step0)) * dt;
  }
  bool ends_interval(std::int64_t step) const {
    return step > step0 && (step - step0) % interval == 0;
  }
  double centre(std::int64_t bin) const { return strike().centre(bin); }
};

/// A vector in the fault; along a line the dip is 0.
struct FaultVector {
  double strike = 0.0, dip = 0.0;

  double size() const { return dip == 0.0 ? std::fabs(strike) : std::hypot(strike, dip); }
  /// That of a cell, from the numbers of all.
  static FaultVector of(const FaultGrid &grid, const std::vector<float> &all, std::size_t cell) {
    if (!grid.plane) return {static_cast<double>(all[cell]), 0.0};
    return {static_cast<double>(all[2 * cell]), static_cast<double>(all[2 * cell + 1])};
  }
};

/// What the bins or cells of the fault did in one interval. Slip and stress along strike are
/// positive in the direction in which the fault is driven, those along dip where the upper side
/// moves up. Slip and stress have the components of each cell one after the other.
struct FaultRow {
  std::vector<float> slip;    ///< mean displacement of the upper face along the lower one
  std::vector<float> work;    ///< work lost to friction
  std::vector<float> stress;  ///< shear force of the contacts per area, mean over the interval
  FaultRow() = default;
  explicit FaultRow(int bins)
      : slip(static_cast<std::size_t>(bins)), work(slip.size()), stress(slip.size()) {}
  explicit FaultRow(const FaultGrid &grid) : FaultRow(grid.cells()) {
    slip.resize(grid.components() * work.size());
    stress.resize(slip.size());
  }
};

/// Defines what slips and what is connected. Part of the header of a slip history.
struct RuptureSettings {
  double velocity = 0.0;    ///< bins whose slip velocity exceeds this slip
  int gap = 0;              ///< bins that may lie between two that are connected, in each direction
  std::int64_t memory = 1;  ///< intervals over which bins are connected, at least 1
  double modulus = 1.0;     ///< shear modulus
};

/// Displacement in an interval above which a bin slips. All code that finds ruptures uses this.
inline double slipping_above(const FaultGrid &grid, double velocity) {
  return velocity * grid.duration();
}

}  // namespace LSM

#endif
