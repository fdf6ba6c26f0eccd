// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ks_distance.h
/// Kolmogorov-Smirnov distance between a sample and a distribution.
#ifndef LSM_POSTPROC_KS_DISTANCE_H
#define LSM_POSTPROC_KS_DISTANCE_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace LSM::postproc {

/// A sample in one of two forms: single values in ascending order, or cells, given by their edges
/// and the number of values below each edge.
struct SamplePoints {
  const double *values;
  std::size_t count;
  const double *below = nullptr;  ///< for cells only

  double n() const { return below ? below[count - 1] - below[0] : static_cast<double>(count); }
  /// Number of values before point i, and up to and including it.
  double before(std::size_t i) const {
    return below ? below[i] - below[0] : static_cast<double>(i);
  }
  double up_to(std::size_t i) const { return before(i) + (below ? 0.0 : 1.0); }
};

/// Largest distance between the empirical distribution of a non-empty sample and the cumulative
/// distribution function cdf(value), which must not decrease; for cells, the largest at their
/// edges. As both functions increase, their values at the ends of a block bound the distance within
/// it. Blocks that cannot exceed the largest distance so far are skipped, so that the exact result
/// takes some hundred evaluations instead of one for each value.
template <class Cdf>
class KsDistance {
 public:
  KsDistance(SamplePoints points, Cdf cdf) : points_(points), n_(points.n()), cdf_(cdf) {}

  /// Computes the distance.
  /// \param give_up if the result exceeds this, it is only a lower bound of the distance
  double operator()(double give_up = std::numeric_limits<double>::infinity()) {
    return search(0.0, give_up);
  }

  /// Only tells whether the distance reaches a given one, which is faster.
  /// \return infinity if the distance is at least this, 0 otherwise
  double against(double distance) {
    const double below = std::nextafter(distance, -1.0);
    return search(below, below) > below ? std::numeric_limits<double>::infinity() : 0.0;
  }

 private:
  double search(double best, double give_up) {
    best_ = best;
    give_up_ = give_up;
    const double first = look(0), last = look(points_.count - 1);
    refine(0, first, points_.count - 1, last);
    return best_;
  }

  double look(std::size_t i) {
    const double f = cdf_(points_.values[i]);
    best_ = std::max({best_, points_.up_to(i) / n_ - f, f - points_.before(i) / n_});
    return f;
  }

  void refine(std::size_t i, double f_i, std::size_t j, double f_j) {
    if (j - i < 2 || best_ > give_up_) return;
    const double above = points_.before(j) / n_ - f_i;
    const double below = f_j - points_.up_to(i) / n_;
    if (std::max(above, below) <= best_) return;
    const std::size_t k = i + (j - i) / 2;
    const double f_k = look(k);
    refine(i, f_i, k, f_k);
    refine(k, f_k, j, f_j);
  }

  SamplePoints points_;
  double n_;
  Cdf cdf_;
  double best_ = 0.0, give_up_ = 0.0;
};

}  // namespace LSM::postproc

#endif
