// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/fault_sums.h
/// What the sums of a fault's bins over an interval say: displacements of the faces, the row of the
/// slip history, and mean places.
#ifndef LSM_FAULT_SUMS_H
#define LSM_FAULT_SUMS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "files/fault_grid.h"

namespace LSM {

/// Mean place of bins with weights: on a ring the circular mean.
class MeanPlace {
 public:
  explicit MeanPlace(const FaultAxis &axis);
  /// What the weight of a bin is multiplied with in the two sums.
  double cosine(std::size_t bin) const { return cosine_[bin]; }
  double sine(std::size_t bin) const { return sine_[bin]; }
  /// The place, from the two sums over the bins; the begin of the fault if there are no weights.
  double of(double cosines, double sines) const;

 private:
  FaultAxis axis_;
  std::vector<double> cosine_, sine_;  // of the direction on the ring; otherwise place and 1
};

/// Sums of a bin over an interval, see SlipRecorder: displacements of the particles of each face
/// and the steps that these took, work and force of the contacts; of a cell of a plane then the
/// displacements and the force along dip.
enum FaultField : std::size_t {
  UPPER,
  UPPER_STEPS,
  LOWER,
  LOWER_STEPS,
  WORK,
  FORCE,
  fault_fields,
  UPPER_DIP = fault_fields,
  LOWER_DIP,
  FORCE_DIP,
  plane_fields
};
/// The number of sums of a cell.
inline std::size_t fields_of(const FaultGrid &grid) {
  return grid.plane ? plane_fields : fault_fields;
}

/// Mean displacement of a face in each cell, in so many steps. That of a cell without particles is
/// interpolated linearly between the nearest two along strike with particles, on a ring across the
/// seam; where a whole row has none, between the nearest two rows with particles.
/// \param field, steps_field of the face
std::vector<double> face_displacements(const FaultGrid &grid, const double *sums, FaultField field,
                                       FaultField steps_field, std::int64_t steps);

/// Calculates the row of an interval from SlipRecorder::sums().
/// \param steps length of the interval
FaultRow fault_row(const FaultGrid &grid, const double *sums, std::int64_t steps);

}  // namespace LSM

#endif
