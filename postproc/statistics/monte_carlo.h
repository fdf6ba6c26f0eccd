// SPDX-License-Identifier: GPL-2.0-or-later
/// \file monte_carlo.h
/// Monte Carlo tests: replicas run in parallel, with random numbers that do not depend on the
/// number of cores, and the goodness of fit of a law that is fitted to each replica as to the data
/// (Clauset, Shalizi & Newman 2009, SIAM Review 51, 661).
#ifndef LSM_POSTPROC_MONTE_CARLO_H
#define LSM_POSTPROC_MONTE_CARLO_H

#include <gsl/gsl_rng.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "gsl_owners.h"
#include "sample.h"

namespace LSM::postproc {

/// Largest sample that tests with refits use value by value; larger ones are reduced to counts in
/// cells, so that a refit costs no more for a larger sample.
constexpr std::size_t largest_exact_sample = 8192;

/// Seed of one replica; the seeds of neighbouring seeds and replicas are unrelated.
std::uint64_t seed_of_replica(std::uint64_t seed, int replica);

using Rng = Gsl<gsl_rng>;

/// Mersenne Twister with a given seed.
Rng generator(std::uint64_t seed);

/// Calls task(0) to task(count - 1), in parallel on all cores that the process may use.
/// \throws the exception of the first task that fails; no further tasks are started then
void for_each_replica(int count, const std::function<void(int)> &task);

/// Monte Carlo p-value (k + 1) / (count + 1), where k replicas are as far off as the data.
/// \param as_far whether the replica of a given number is; called from any thread
double share_of_replicas(int count, const std::function<bool(int)> &as_far);

/// A law that was fitted to a sample, and how to fit it again. Functions are called from any
/// thread, `draw` from one at a time.
struct FittedLaw {
  using Function = std::function<double(double)>;
  Function survival;  ///< probability of exceeding a value; must not increase
  std::function<std::vector<double>(gsl_rng *)> draw;  ///< a sample of the size of the data
  /// Cumulative distribution function of the best law for a sample; empty: there is none.
  std::function<Function(const Sample &)> refit;
  /// Edges that cells must have, ascending, including the first and the last one.
  std::vector<double> edges;
  bool in_bins = false;  ///< the edges are all, as of data in bins of their own
};

/// Monte Carlo p-value of the fit: share of samples drawn from the law, each fitted like the data,
/// whose Kolmogorov-Smirnov distance is at least that of the data. Data in bins, and more values
/// than largest_exact_sample, are counted, like the replicas, in the same cells (our method, not
/// the paper's), which makes a test as valid as one of single values: about 2000 cells with at most
/// a thousandth of the probability each, and towards both ends at most a twentieth of what lies
/// beyond, down to a thousandth of a single value.
/// \param sorted the data in ascending order
/// \param distance that of the data and the fitted law; not used for cells
double share_of_worse_fits(const FittedLaw &law, const std::vector<double> &sorted, double distance,
                           int replicas, std::uint64_t seed);

}  // namespace LSM::postproc

#endif
