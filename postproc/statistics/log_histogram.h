// SPDX-License-Identifier: GPL-2.0-or-later
/// \file log_histogram.h
/// Probability densities in bins of equal logarithmic width (paper Sect. 4.1, after Corral 2004),
/// with edges factor^n, or origin factor^n, for every integer n.
#ifndef LSM_POSTPROC_LOG_HISTOGRAM_H
#define LSM_POSTPROC_LOG_HISTOGRAM_H

#include <cstdint>
#include <limits>
#include <vector>

namespace LSM::postproc {

/// One bin [lo, hi).
struct LogBin {
  double lo, hi;
  double centre;       ///< geometric mean of the edges
  std::int64_t count;  ///< samples in the bin
  double density;      ///< count / (N (hi - lo)), N the number of samples in all bins
  double error;        ///< Poisson error of density: sqrt(count) / (N (hi - lo)); 0 if empty
};

/// Ratio of the edges of a bin: ten bins per decade † (the paper does not give its c).
constexpr double usual_bin_factor = 1.2589254117941673;

/// Bins the positive finite values. The bins returned have lower edges at or above threshold (to
/// 1e-9 relative, so that 1e-4 is an edge of 10^(1/10) bins) and upper edges not above upto; they
/// range from the first to the last bin with a value, including empty ones in between. The
/// densities integrate to one over these bins.
/// \return empty if there is no such value
/// \throws std::invalid_argument unless factor is finite and at least 1.0001
std::vector<LogBin> log_histogram(const std::vector<double> &values,
                                  double factor = usual_bin_factor, double threshold = 0.0,
                                  double upto = std::numeric_limits<double>::infinity(),
                                  double origin = 1.0);

}  // namespace LSM::postproc

#endif
