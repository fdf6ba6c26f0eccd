// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/slip_recorder.h
/// Records on each rank where a fault slips: displacements of its two faces, and work and force of
/// the contacts between its two sides, summed in bins and intervals.
#ifndef LSM_SLIP_RECORDER_H
#define LSM_SLIP_RECORDER_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "events/fault_grid.h"

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

/// Displacement along x of a particle of one of the two faces of the fault, in so many steps.
struct FaceDisplacement {
  double x;  ///< position in the middle of these steps
  double displacement;
  double steps;
  bool upper;
};

/// Sums over the contacts and faces of one rank, by bins and intervals. Sums of several ranks can
/// be added.
class SlipRecorder {
 public:
  /// Starts with empty sums.
  /// \param forward direction in which the upper side is driven along x, 1 or -1
  void begin(const FaultGrid &grid, double forward) {
    grid_ = grid;
    forward_ = forward;
    sums_.assign(fault_fields * static_cast<std::size_t>(grid.bins), 0.0);
  }

  const FaultGrid &grid() const { return grid_; }
  /// The sums of the incomplete interval, fault_fields of each bin.
  std::vector<double> &sums() { return sums_; }
  void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

  /// Adds the contacts before the first interval, of which only the forces are needed.
  void add_forces(const std::vector<FaultContact> &contacts) {
    for (const FaultContact &c : contacts) at(c.x)[FORCE] += c.share * (forward_ * c.force);
  }
  /// Contacts of a step.
  void add(const std::vector<FaultContact> &contacts) {
    for (const FaultContact &c : contacts) {
      double *const sums = at(c.x);
      sums[WORK] += c.share * c.work;
      sums[FORCE] += c.share * (forward_ * c.force);
    }
  }
  void add(const std::vector<FaceDisplacement> &faces) {
    for (const FaceDisplacement &f : faces) {
      double *const sums = at(f.x) + (f.upper ? UPPER : LOWER);
      sums[0] += forward_ * f.displacement;
      sums[1] += f.steps;
    }
  }

 private:
  /// The sums of the bin at x.
  double *at(double x) {
    double along = (x - grid_.x0) / grid_.length();
    along = grid_.ring ? along - std::floor(along) : std::max(along, 0.0);
    const int bin = std::min(static_cast<int>(along * grid_.bins), grid_.bins - 1);
    return &sums_[fault_fields * static_cast<std::size_t>(bin)];
  }

  FaultGrid grid_;
  double forward_ = 1.0;
  std::vector<double> sums_;
};

}  // namespace LSM

#endif
