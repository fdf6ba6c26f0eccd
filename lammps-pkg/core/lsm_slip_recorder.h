// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_slip_recorder.h
/// Where a fault slips: sums of its contacts for ruptures, on each rank, and the places of events
/// that were picked from PE, on the rank that has them all. (Ours.)
#ifndef LSM_SLIP_RECORDER_H
#define LSM_SLIP_RECORDER_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "lsm_event_picker.h"
#include "lsm_ruptures.h"

namespace LSM {

/// Slip of one contact during one step.
struct ContactSlip {
  double along;   ///< its place: distance along x from the begin of the fault, less than its length
  double moment;  ///< |slip| times contact size
};

/// Slip of the contacts inside one bin along the fault during one step.
struct BinSlip {
  double bin;     ///< index of the bin along x
  double moment;  ///< sum of |slip| times contact size
};

/// A contact in one force evaluation, seen as part of a fault along x: what the upper particle does
/// to the lower one.
struct FaultContact {
  double x;      ///< middle between the two centres
  double slip;   ///< of the upper particle along x; only the irreversible part
  double work;   ///< lost to friction
  double force;  ///< on the lower particle along x
  double share;  ///< 1, or 0.5 where another rank has the contact as well
};

/// Sums up one rank's contacts over the intervals of a fault.
class SlipRecorder {
 public:
  /// forward: direction in which the upper side is driven along x, 1 or -1.
  void begin(const FaultGrid &grid, double forward) {
    grid_ = grid;
    forward_ = forward;
    sums_ = FaultSums(grid);
  }

  const FaultGrid &grid() const { return grid_; }
  /// The sums of the interval that is not complete.
  std::vector<double> &sums() { return sums_.values(); }
  void clear() { sums_.clear(); }

  /// Contacts of the state before the first interval, of which only the forces count.
  void add_forces(const std::vector<FaultContact> &contacts) {
    for (const FaultContact &c : contacts) sums_.add(c.x, 0.0, 0.0, forward_ * c.force, c.share);
  }
  /// Contacts of a step.
  void add(const std::vector<FaultContact> &contacts) {
    for (const FaultContact &c : contacts)
      sums_.add(c.x, forward_ * c.slip, c.work, forward_ * c.force, c.share);
  }

 private:
  FaultGrid grid_;
  double forward_ = 1.0;
  FaultSums sums_;
};

/// Moment of the bins since the open event commenced, and what follows from it for the event.
class EventLocator {
 public:
  /// bin_width > 0; fraction: bins with at most this part of the largest moment are not ruptured.
  EventLocator(double bin_width, double fraction) : bin_width_(bin_width), fraction_(fraction) {}

  void add(const std::vector<BinSlip> &slips) {
    for (const BinSlip &s : slips) moment_[static_cast<int>(s.bin)] += s.moment;
  }
  void clear() { moment_.clear(); }

  /// Sets slip moment, centroid and rupture length; the fault begins at x0 and has that length as
  /// its period. Centroid: direction of the mean of the bins on the circle that the period makes.
  void locate(double x0, double length, Event &event) const {
    double largest = 0.0, sum = 0.0, c = 0.0, s = 0.0;
    for (const auto &[bin, moment] : moment_) {
      const double angle = 2.0 * pi * (bin + 0.5) * bin_width_ / length;
      largest = std::max(largest, moment);
      sum += moment;
      c += moment * std::cos(angle);
      s += moment * std::sin(angle);
    }
    int ruptured = 0;
    for (const auto &bin : moment_)
      if (bin.second > fraction_ * largest) ++ruptured;
    double along = std::atan2(s, c) / (2.0 * pi);
    if (along < 0.0) along += 1.0;
    event.slip_moment = sum;
    event.x_centroid = x0 + along * length;
    event.rupture_length = std::min(ruptured * bin_width_, length);
  }

  /// For restarts: pairs of bin and moment.
  std::vector<double> state() const {
    std::vector<double> out;
    for (const auto &[bin, moment] : moment_) {
      out.push_back(bin);
      out.push_back(moment);
    }
    return out;
  }
  /// The pairs in saved from place `at` on.
  void set_state(const std::vector<double> &saved, std::size_t at) {
    moment_.clear();
    for (std::size_t n = at; n + 1 < saved.size(); n += 2)
      moment_[static_cast<int>(saved[n])] = saved[n + 1];
  }

 private:
  static constexpr double pi = 3.14159265358979323846;

  double bin_width_, fraction_;
  std::map<int, double> moment_;
};

}  // namespace LSM

#endif
