// SPDX-License-Identifier: GPL-2.0-or-later
/// \file ks_distance.h
/// Kolmogorov-Smirnov distance between a sample and a law.
#ifndef LSM_POSTPROC_KS_DISTANCE_H
#define LSM_POSTPROC_KS_DISTANCE_H

#include <algorithm>
#include <cstddef>
#include <limits>

namespace LSM::postproc {

/// Largest distance between the empirical distribution of sorted[0..count), count >= 1, and the
/// cumulative distribution cdf(value), which must not fall. Both rise, so that within a block of
/// values nothing exceeds a bound given by the law at its ends; blocks that cannot beat the best so
/// far are skipped, and the exact distance costs some hundred evaluations instead of count.
template <class Cdf>
class KsDistance {
 public:
  KsDistance(const double *sorted, std::size_t count, Cdf cdf)
      : sorted_(sorted), n_(static_cast<double>(count)), count_(count), cdf_(cdf) {}

  /// A result above give_up only means that the distance is at least that much.
  double operator()(double give_up = std::numeric_limits<double>::infinity()) {
    best_ = 0.0;
    give_up_ = give_up;
    const double first = look(0), last = look(count_ - 1);
    refine(0, first, count_ - 1, last);
    return best_;
  }

 private:
  double look(std::size_t i) {
    const double f = cdf_(sorted_[i]);
    const auto rank = static_cast<double>(i);
    best_ = std::max({best_, (rank + 1.0) / n_ - f, f - rank / n_});
    return f;
  }

  void refine(std::size_t i, double f_i, std::size_t j, double f_j) {
    if (j - i < 2 || best_ > give_up_) return;
    const double above = static_cast<double>(j) / n_ - f_i;
    const double below = f_j - static_cast<double>(i + 1) / n_;
    if (std::max(above, below) <= best_) return;
    const std::size_t k = i + (j - i) / 2;
    const double f_k = look(k);
    refine(i, f_i, k, f_k);
    refine(k, f_k, j, f_j);
  }

  const double *sorted_;
  double n_;
  std::size_t count_;
  Cdf cdf_;
  double best_ = 0.0, give_up_ = 0.0;
};

}  // namespace LSM::postproc

#endif
