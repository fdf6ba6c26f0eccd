// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numerics/circular_mean.h
/// Circular mean of places on a ring, independent of its seam.
#ifndef LSM_CIRCULAR_MEAN_H
#define LSM_CIRCULAR_MEAN_H

#include <cmath>

#include "numerics/constants.h"

namespace LSM {

/// A direction as a part of the whole ring, from 0 to less than 1.
inline double part_of_ring(double sine, double cosine) {
  double part = std::atan2(sine, cosine) / (2.0 * pi);
  if (part < 0.0) part += 1.0;
  return part < 1.0 ? part : 0.0;  // a negative angle of about -1e-17 is rounded to 1
}

class CircularMean {
 public:
  /// \param length of the ring, > 0
  explicit CircularMean(double length) : length_(length), circle_(2.0 * pi / length) {}

  void add(double position, double weight) {
    cosine_ += weight * std::cos(circle_ * position);
    sine_ += weight * std::sin(circle_ * position);
  }
  /// The mean, from 0 to less than the length; 0 if the weights cancel or there are none.
  double position() const {
    if (cosine_ == 0.0 && sine_ == 0.0) return 0.0;
    return part_of_ring(sine_, cosine_) * length_;
  }

 private:
  double length_, circle_, cosine_ = 0.0, sine_ = 0.0;
};

}  // namespace LSM

#endif
