// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_circular_mean.h
/// Mean of places on a ring, which a seam must not pull apart: that of their directions.
#ifndef LSM_CIRCULAR_MEAN_H
#define LSM_CIRCULAR_MEAN_H

#include <cmath>

namespace LSM {

class CircularMean {
 public:
  /// \param length of the ring, > 0
  explicit CircularMean(double length) : length_(length), circle_(2.0 * pi / length) {}

  void add(double position, double weight) {
    cosine_ += weight * std::cos(circle_ * position);
    sine_ += weight * std::sin(circle_ * position);
  }
  /// From 0 to less than the length; 0 if the weights cancel or there are none.
  double position() const {
    if (cosine_ == 0.0 && sine_ == 0.0) return 0.0;
    const double x = std::atan2(sine_, cosine_) / circle_;
    return x < 0.0 ? x + length_ : x;
  }

 private:
  static constexpr double pi = 3.14159265358979323846;
  double length_, circle_, cosine_ = 0.0, sine_ = 0.0;
};

}  // namespace LSM

#endif
