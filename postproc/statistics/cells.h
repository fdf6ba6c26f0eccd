// SPDX-License-Identifier: GPL-2.0-or-later
/// \file cells.h
/// Large samples by cells. A Monte Carlo test of a fit that takes both the data and its replicas by
/// the same cells is as sound as one of single values, and its refits cost no more for more data.
/// (Ours.)
#ifndef LSM_POSTPROC_CELLS_H
#define LSM_POSTPROC_CELLS_H

#include <gsl/gsl_rng.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace LSM::postproc {

/// Cells [edge i, edge i + 1) and the probabilities of a law in them: some 2000 of at most a
/// thousandth each, and towards both ends of at most a twentieth of what lies beyond, down to a
/// thousandth of a value of the sample.
class Cells {
 public:
  /// \param survival probability beyond a value; must not rise
  /// \param required edges that there have to be, ascending, the first and last one included
  /// \param n size of the sample
  Cells(const std::function<double(double)> &survival, const std::vector<double> &required,
        double n);

  std::size_t size() const { return probabilities_.size(); }
  const std::vector<double> &edges() const { return edges_; }  ///< one more than cells
  const std::vector<double> &centres() const { return centres_; }

  /// Share of samples drawn from the law whose distance is as large as that of this one.
  /// \param sorted ascending
  /// \param distance of how many values are in each cell, on any thread; the second argument is
  /// that of the data, or not a number: only which of both is larger counts then
  double share_as_far(
      const std::vector<double> &sorted, int replicas, std::uint64_t seed,
      const std::function<double(const std::vector<double> &, double)> &distance) const;

 private:
  /// Those beyond the ends are in the last ones.
  std::vector<double> count(const std::vector<double> &sorted) const;
  /// Of as many values from the law.
  std::vector<double> draw(gsl_rng *rng) const;
  void add(const std::function<double(double)> &survival, double lo, double above_lo, double hi,
           double above_hi);

  double n_;
  std::vector<double> edges_, centres_, probabilities_, from_here_;
};

}  // namespace LSM::postproc

#endif
