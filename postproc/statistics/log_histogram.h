// SPDX-License-Identifier: GPL-2.0-or-later
/// \file log_histogram.h
/// Probability densities over bins of equal width in the logarithm (paper Sect. 4.1, after Corral
/// 2004): edges factor^n for every integer n.
#ifndef LSM_POSTPROC_LOG_HISTOGRAM_H
#define LSM_POSTPROC_LOG_HISTOGRAM_H

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace LSM::postproc {

/// One bin [lo, hi).
struct LogBin {
  double lo, hi;
  double centre;       ///< geometric mean of the edges
  std::int64_t count;  ///< samples in the bin
  double density;      ///< count / (N (hi - lo)), N the samples in all bins returned together
  double error;        ///< Poisson error of density: sqrt(count) / (N (hi - lo)); 0 if empty
};

/// Histogram with edges factor^n, filled one sample at a time; memory grows with the number of
/// occupied bins only.
class LogHistogram {
 public:
  /// Ten bins a decade (ours: the paper does not give its c).
  static constexpr double default_factor = 1.2589254117941673;

  /// \throws std::invalid_argument unless factor is finite and at least 1.0001
  explicit LogHistogram(double factor = default_factor);
  /// Of all values.
  explicit LogHistogram(const std::vector<double> &values, double factor = default_factor)
      : LogHistogram(factor) {
    for (const double value : values) add(value);
  }

  /// Samples that are zero, negative or not finite are only counted, see outside().
  void add(double value);

  /// Bins whose lower edge is at or above threshold (to 1e-9 relative, so that 1e-4 is an edge of
  /// 10^(1/10) bins) and whose upper edge does not exceed upto, from the first to the last that
  /// holds a sample; empty bins between them are included. The densities integrate to one over the
  /// bins returned. Empty if there is no such sample.
  std::vector<LogBin> bins(double threshold = 0.0,
                           double upto = std::numeric_limits<double>::infinity()) const;

  double factor() const { return factor_; }
  std::int64_t total() const { return total_; }      ///< positive finite samples
  std::int64_t outside() const { return outside_; }  ///< zero, negative, infinite or NaN samples

 private:
  double edge(std::int64_t n) const;

  double factor_, log_factor_;
  std::map<std::int64_t, std::int64_t> counts_;
  std::int64_t total_ = 0, outside_ = 0;
};

}  // namespace LSM::postproc

#endif
