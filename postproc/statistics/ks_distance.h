// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ks_distance.h
/// Kolmogorov-Smirnov distance between a sample and a law.
#ifndef LSM_POSTPROC_KS_DISTANCE_H
#define LSM_POSTPROC_KS_DISTANCE_H

#include <algorithm>
#include <cstddef>
#include <limits>

namespace LSM::postproc {

/// A sample as it is: ascending values, one at a time.
class SortedValues {
 public:
  SortedValues(const double *sorted, std::size_t count)
      : sorted_(sorted), count_(count), n_(static_cast<double>(count)) {}
  std::size_t size() const { return count_; }
  double value(std::size_t i) const { return sorted_[i]; }
  /// Shares of the sample before value i and up to it.
  double before(std::size_t i) const { return static_cast<double>(i) / n_; }
  double up_to(std::size_t i) const { return (static_cast<double>(i) + 1.0) / n_; }

 private:
  const double *sorted_;
  std::size_t count_;
  double n_;
};

/// A sample by cells: their edges, and how many values are below each of them.
class CountedEdges {
 public:
  CountedEdges(const double *edges, const double *below, std::size_t count)
      : edges_(edges), below_(below), count_(count), n_(below[count - 1] - below[0]) {}
  std::size_t size() const { return count_; }
  double value(std::size_t i) const { return edges_[i]; }
  double before(std::size_t i) const { return (below_[i] - below_[0]) / n_; }
  double up_to(std::size_t i) const { return before(i); }

 private:
  const double *edges_, *below_;
  std::size_t count_;
  double n_;
};

/// Largest distance between the empirical distribution of a sample, not empty, and the cumulative
/// distribution cdf(value), which must not fall. Both rise, so that within a block of values
/// nothing exceeds a bound given by the law at its ends; blocks that cannot beat the best so far
/// are skipped, and the exact distance costs some hundred evaluations instead of one for each
/// value. Of a sample by cells it is the largest at their edges.
template <class Points, class Cdf>
class KsDistance {
 public:
  KsDistance(Points points, Cdf cdf) : points_(points), cdf_(cdf) {}

  /// A result above give_up only means that the distance is at least that much.
  double operator()(double give_up = std::numeric_limits<double>::infinity()) {
    best_ = 0.0;
    give_up_ = give_up;
    const double first = look(0), last = look(points_.size() - 1);
    refine(0, first, points_.size() - 1, last);
    return best_;
  }

 private:
  double look(std::size_t i) {
    const double f = cdf_(points_.value(i));
    best_ = std::max({best_, points_.up_to(i) - f, f - points_.before(i)});
    return f;
  }

  void refine(std::size_t i, double f_i, std::size_t j, double f_j) {
    if (j - i < 2 || best_ > give_up_) return;
    const double above = points_.before(j) - f_i;
    const double below = f_j - points_.up_to(i);
    if (std::max(above, below) <= best_) return;
    const std::size_t k = i + (j - i) / 2;
    const double f_k = look(k);
    refine(i, f_i, k, f_k);
    refine(k, f_k, j, f_j);
  }

  Points points_;
  Cdf cdf_;
  double best_ = 0.0, give_up_ = 0.0;
};

}  // namespace LSM::postproc

#endif
