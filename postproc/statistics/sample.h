// SPDX-License-Identifier: GPL-2.0-or-later
/// \file sample.h
/// A sample as estimators use it: single values, or counts in cells where only these are known or
/// the sample is large; means over it, and its Kolmogorov-Smirnov distance from a law.
#ifndef LSM_POSTPROC_SAMPLE_H
#define LSM_POSTPROC_SAMPLE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "numerics/sum.h"

namespace LSM::postproc {

class Sample {
 public:
  explicit Sample(std::vector<double> values)
      : values_(std::move(values)), n_(static_cast<double>(values_.size())) {}
  /// Counts in cells, each represented by its centre.
  /// \param edges one more than there are cells, ascending
  Sample(std::vector<double> edges, const std::vector<double> &centres,
         const std::vector<double> &counts)
      : edges_(std::move(edges)), below_{0.0} {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      below_.push_back(below_.back() + counts[i]);
      if (!(counts[i] > 0.0)) continue;
      values_.push_back(centres[i]);
      counts_.push_back(counts[i]);
    }
    n_ = below_.back();
  }

  double n() const { return n_; }
  /// Sorts the values, as distances require. (Sums depend on the order by rounding.)
  void sort() {
    if (edges_.empty()) std::sort(values_.begin(), values_.end());
  }

  /// Mean of f over the sample.
  template <class F>
  double mean(const F &f) const {
    return mean_of([&f](double value) { return std::array<double, 1>{f(value)}; })[0];
  }
  /// Means of several functions, which f returns as an array.
  template <class F>
  auto mean_of(const F &f) const {
    std::array<NeumaierSum, std::tuple_size_v<decltype(f(0.0))>> sums;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      auto terms = f(values_[i]);
      for (std::size_t k = 0; k < terms.size(); ++k)
        sums[k].add(counts_.empty() ? terms[k] : counts_[i] * terms[k]);
    }
    auto means = f(0.0);
    for (std::size_t k = 0; k < means.size(); ++k) means[k] = sums[k].value() / n_;
    return means;
  }

  /// Largest distance between the empirical distribution of a sorted, non-empty sample and the
  /// cumulative distribution function cdf(value), which must not decrease; in cells, the largest at
  /// their edges. As both functions increase, their values at the ends of a block bound the
  /// distance within it. Blocks that cannot exceed the largest distance so far are skipped, so that
  /// the exact result takes some hundred evaluations instead of one for each value.
  template <class Cdf>
  double distance(const Cdf &cdf) const {
    return Search<Cdf>{*this, cdf, 0.0, std::numeric_limits<double>::infinity()}.run();
  }
  /// Whether distance(cdf) is at least a given one; faster.
  template <class Cdf>
  bool is_as_far(const Cdf &cdf, double given) const {
    const double below = std::nextafter(given, -1.0);
    return Search<Cdf>{*this, cdf, below, below}.run() > below;
  }

 private:
  /// Values, or edges, at which the distributions are compared.
  const std::vector<double> &points() const { return edges_.empty() ? values_ : edges_; }
  /// Share of the values before point i, and up to and including it.
  double before(std::size_t i) const {
    return (edges_.empty() ? static_cast<double>(i) : below_[i]) / n_;
  }
  double up_to(std::size_t i) const { return edges_.empty() ? before(i + 1) : before(i); }

  /// Search for a distance above `best`, given up when it exceeds `enough`.
  template <class Cdf>
  struct Search {
    const Sample &sample;
    const Cdf &cdf;
    double best, enough;

    double run() {
      const std::size_t last = sample.points().size() - 1;
      const double f_first = look(0), f_last = look(last);
      refine(0, f_first, last, f_last);
      return best;
    }
    double look(std::size_t i) {
      const double f = cdf(sample.points()[i]);
      best = std::max({best, sample.up_to(i) - f, f - sample.before(i)});
      return f;
    }
    void refine(std::size_t i, double f_i, std::size_t j, double f_j) {
      if (j - i < 2 || best > enough) return;
      if (std::max(sample.before(j) - f_i, f_j - sample.up_to(i)) <= best) return;
      const std::size_t k = i + (j - i) / 2;
      const double f_k = look(k);
      refine(i, f_i, k, f_k);
      refine(k, f_k, j, f_j);
    }
  };

  std::vector<double> values_, counts_;  ///< counts_ is empty if each value counts once
  std::vector<double> edges_, below_;    ///< of cells, and the number of values below each edge
  double n_ = 0.0;
};

}  // namespace LSM::postproc

#endif
