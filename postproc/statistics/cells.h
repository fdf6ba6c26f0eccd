// SPDX-License-Identifier: GPL-2.0-or-later
/// \file cells.h
/// Large samples reduced to counts in cells. A Monte Carlo test that fits the data and its replicas
/// to the counts in the same cells is as valid as one of single values, and a refit costs no more
/// for a larger sample. (Our method, not the paper's.)
#ifndef LSM_POSTPROC_CELLS_H
#define LSM_POSTPROC_CELLS_H

#include <gsl/gsl_rng.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace LSM::postproc {

/// Cells [edge i, edge i + 1) and the probability of a law in each: about 2000 cells with at most a
/// thousandth each, and towards both ends at most a twentieth of the probability that lies beyond,
/// down to a thousandth of a single value of the sample.
class Cells {
 public:
  /// Divides the range of a law into cells.
  /// \param survival probability of exceeding a value; must not increase
  /// \param required edges that must be present, ascending, including the first and the last one
  /// \param n size of the sample
  /// \param no_others the required edges are all, as for data in bins of their own
  Cells(const std::function<double(double)> &survival, const std::vector<double> &required,
        double n, bool no_others = false);

  std::size_t size() const { return probabilities_.size(); }
  const std::vector<double> &edges() const { return edges_; }  ///< number of cells + 1
  const std::vector<double> &centres() const { return centres_; }

  /// Monte Carlo p-value: the share of samples drawn from the law whose distance is as large as
  /// that of the data.
  /// \param sorted the data in ascending order
  /// \param replicas number of samples drawn
  /// \param seed of the random numbers
  /// \param distance from the counts in the cells, callable from any thread; its second argument is
  /// the distance of the data (only whether the result reaches it matters then), or NaN
  double share_as_far(
      const std::vector<double> &sorted, int replicas, std::uint64_t seed,
      const std::function<double(const std::vector<double> &, double)> &distance) const;

 private:
  /// Values beyond the ends are counted in the outermost cells.
  std::vector<double> count(const std::vector<double> &sorted) const;
  /// Counts of a sample of the same size drawn from the law.
  std::vector<double> draw(gsl_rng *rng) const;
  void add(const std::function<double(double)> &survival, double lo, double above_lo, double hi,
           double above_hi);

  double n_;
  bool no_others_;
  std::vector<double> edges_, centres_, probabilities_, from_here_;
};

}  // namespace LSM::postproc

#endif
