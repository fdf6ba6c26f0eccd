// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/fault_grid.h
/// Divides a fault into bins along it and time into intervals of some steps, and describes what the
/// faces did in each.
///
/// Values of a bin and interval are kept as floats: thus the slip history has exactly the numbers
/// from which events were found, and sums over several ranks, which differ in the order of the
/// additions, give the same numbers.
#ifndef LSM_FAULT_GRID_H
#define LSM_FAULT_GRID_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace LSM {

/// How the fault is divided, and the times of the intervals.
struct FaultGrid {
  int bins = 1;
  double x0 = 0.0;            ///< lower edge of the first bin
  double width = 1.0;         ///< of a bin; the length of the fault is bins * width
  std::int64_t step0 = 0;     ///< step at which the first interval begins
  std::int64_t interval = 1;  ///< steps in an interval
  double time0 = 0.0;         ///< time at step0
  double dt = 1.0;            ///< time of a step
  bool ring = true;           ///< periodic; otherwise the fault has two ends

  double length() const { return bins * width; }
  double duration() const { return static_cast<double>(interval) * dt; }  ///< of an interval
  double time(std::int64_t step) const;
  bool ends_interval(std::int64_t step) const;
  double centre(std::int64_t bin) const { return x0 + (static_cast<double>(bin) + 0.5) * width; }
};

/// Mean place of bins with weights: on a ring the circular mean.
class MeanPlace {
 public:
  explicit MeanPlace(const FaultGrid &grid);
  /// What the weight of a bin is multiplied with in the two sums.
  double cosine(std::size_t bin) const { return cosine_[bin]; }
  double sine(std::size_t bin) const { return sine_[bin]; }
  /// The place, from the two sums over the bins; the begin of the fault if there are no weights.
  double of(double cosines, double sines) const;

 private:
  FaultGrid grid_;
  std::vector<double> cosine_, sine_;  // of the direction on the ring; otherwise place and 1
};

/// What the bins of the fault did in one interval. Slip and stress are positive in the direction in
/// which the fault is driven.
struct FaultRow {
  std::vector<float> slip;    ///< mean displacement of the upper face along the lower one
  std::vector<float> work;    ///< work lost to friction
  std::vector<float> stress;  ///< shear force of the contacts per length, mean over the interval
  FaultRow() = default;
  explicit FaultRow(int bins)
      : slip(static_cast<std::size_t>(bins)), work(slip.size()), stress(slip.size()) {}
};

/// Sums of a bin over an interval, see SlipRecorder: displacements of the particles of each face
/// and the steps that these took, work and force of the contacts.
enum FaultField : std::size_t { UPPER, UPPER_STEPS, LOWER, LOWER_STEPS, WORK, FORCE, fault_fields };

/// Mean displacement of a face in each bin, in so many steps; that of a bin without particles is
/// interpolated linearly between the nearest two with particles, on a ring across the seam.
std::vector<double> face_displacements(const FaultGrid &grid, const double *sums,
                                       std::int64_t steps);

/// Calculates the row of an interval from SlipRecorder::sums().
/// \param steps length of the interval
FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps);

/// Defines what slips and what is connected. Part of the header of a slip history.
struct RuptureSettings {
  double velocity = 0.0;    ///< bins whose slip velocity exceeds this slip
  int gap = 0;              ///< bins that may lie between two that are connected
  std::int64_t memory = 1;  ///< intervals over which bins are connected, at least 1
  double modulus = 1.0;     ///< shear modulus
};

/// Displacement in an interval above which a bin slips. All code that finds ruptures uses this.
double slipping_above(const FaultGrid &grid, double velocity);

}  // namespace LSM

#endif
