// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/slip_recorder.h
/// Records on each rank where a fault slips: displacements of its two faces, and work and force of
/// the contacts between its two sides, summed in bins and intervals.
#ifndef LSM_SLIP_RECORDER_H
#define LSM_SLIP_RECORDER_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "events/fault_sums.h"

namespace LSM {

/// A contact between the two sides of a fault along x, and in three dimensions along z, in one
/// force evaluation.
struct FaultContact {
  double x;              ///< middle between the two centres
  double work;           ///< lost to friction
  double force;          ///< on the lower particle along x
  double share;          ///< 1, or 0.5 where another rank has the contact as well
  double z = 0.0;        ///< middle along z
  double force_z = 0.0;  ///< on the lower particle along z
};

/// Displacement along x, and on a plane along z, of a particle of one of the two faces of the
/// fault, in so many steps.
struct FaceDisplacement {
  double x;  ///< position in the middle of these steps
  double displacement;
  double steps;
  bool upper;
  double z = 0.0, displacement_z = 0.0;
};

/// Sums over the contacts and faces of one rank, by cells and intervals. Sums of several ranks can
/// be added.
class SlipRecorder {
 public:
  /// Starts with empty sums.
  /// \param forward direction in which the upper side is driven along x, 1 or -1
  void begin(const FaultGrid &grid, double forward) {
    grid_ = grid;
    forward_ = forward;
    sums_.assign(fields_of(grid) * static_cast<std::size_t>(grid.cells()), 0.0);
  }

  const FaultGrid &grid() const { return grid_; }
  /// The sums of the incomplete interval, fields_of(grid) of each cell.
  std::vector<double> &sums() { return sums_; }
  void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

  /// Adds the contacts before the first interval, of which only the forces are needed.
  void add_forces(const std::vector<FaultContact> &contacts) {
    for (const FaultContact &c : contacts) add_force(at(c.x, c.z), c);
  }
  /// Adds contacts of a step. Returns what they lost to friction.
  double add(const std::vector<FaultContact> &contacts) {
    double lost = 0.0;
    for (const FaultContact &c : contacts) {
      double *const sums = at(c.x, c.z);
      const double work = c.share * c.work;
      sums[WORK] += work;
      lost += work;
      add_force(sums, c);
    }
    return lost;
  }
  void add(const std::vector<FaceDisplacement> &faces) {
    for (const FaceDisplacement &f : faces) {
      double *const sums = at(f.x, f.z);
      sums[f.upper ? UPPER : LOWER] += forward_ * f.displacement;
      sums[f.upper ? UPPER_STEPS : LOWER_STEPS] += f.steps;
      if (grid_.plane) sums[f.upper ? UPPER_DIP : LOWER_DIP] += f.displacement_z;
    }
  }

 private:
  /// The sums of the cell at a place.
  double *at(double x, double z) {
    const int bin = grid_.strike().bin(x);
    const int cell = grid_.plane ? bin * grid_.rows + grid_.dip().bin(z) : bin;
    return &sums_[fields_of(grid_) * static_cast<std::size_t>(cell)];
  }
  void add_force(double *sums, const FaultContact &c) const {
    sums[FORCE] += c.share * (forward_ * c.force);
    if (grid_.plane) sums[FORCE_DIP] += c.share * c.force_z;
  }

  FaultGrid grid_;
  double forward_ = 1.0;
  std::vector<double> sums_;
};

}  // namespace LSM

#endif
