// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numerics/sum.h
/// Accurate sums: the sign of the change of the potential energy per step matters at 1e-9 of the
/// energy itself, and running sums go over 1e7 steps and more.
#ifndef LSM_SUM_H
#define LSM_SUM_H

#include <cmath>
#include <cstddef>

namespace LSM {

/// Running sum with Neumaier's compensation: error of the order of one rounding of the result,
/// independent of the number of terms as long as that stays far below 1e16.
class NeumaierSum {
 public:
  NeumaierSum() = default;
  /// Starts from a given value, or from a saved pair, so that a restart is exact.
  explicit NeumaierSum(double sum, double compensation = 0.0)
      : sum_(sum), compensation_(compensation) {}

  void add(double term) {
#ifdef __FAST_MATH__
    // Value-changing optimisations would cancel the compensation algebraically.
    volatile double total = sum_ + term;
#else
    const double total = sum_ + term;
#endif
    if (std::fabs(sum_) >= std::fabs(term))
      compensation_ += (sum_ - total) + term;
    else
      compensation_ += (term - total) + sum_;
    sum_ = total;
  }

  /// The compensated sum. Infinite or NaN terms give what a plain sum would give.
  double value() const {
    const double total = sum_ + compensation_;
    // After an overflow or an infinite term the compensation is NaN (inf - inf) and means nothing.
    return std::isfinite(sum_) ? total : sum_;
  }

  double sum() const { return sum_; }                    ///< uncompensated part, for restarts
  double compensation() const { return compensation_; }  ///< compensation, for restarts

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.sum_, self.compensation_);
  }

 private:
  double sum_ = 0.0;
  double compensation_ = 0.0;
};

/// Sum of values[0..count) by recursive halving: error grows as log2(count), order of additions
/// depends on count only. Returns 0 for an empty array.
inline double sum_pairwise(const double *values, std::size_t count) {
  // Below this length the plain loop is faster and its error still small.
  constexpr std::size_t block = 32;
  if (count <= block) {
    double total = 0.0;
    for (std::size_t i = 0; i < count; ++i) total += values[i];
    return total;
  }
  const std::size_t half = count / 2;
  return sum_pairwise(values, half) + sum_pairwise(values + half, count - half);
}

}  // namespace LSM

#endif
