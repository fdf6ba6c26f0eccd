// SPDX-License-Identifier: GPL-2.0-or-later
/// \file replicas.h
/// Replicas of Monte Carlo tests, run in parallel with random numbers that do not depend on the
/// number of cores.
#ifndef LSM_POSTPROC_REPLICAS_H
#define LSM_POSTPROC_REPLICAS_H

#include <gsl/gsl_rng.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>

#include "gsl_owners.h"

namespace LSM::postproc {

/// Largest sample that tests with refits use value by value; larger ones are reduced to counts in
/// cells (see cells.h), so that the cost of a refit is bounded.
constexpr std::int64_t largest_exact_sample = 8192;

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
/// The same for samples that draw() returns one after the other, called from one thread at a time.
template <class Draw, class AsFar>
double share_of_draws(int count, Draw draw, AsFar as_far) {
  std::mutex drawing;
  return share_of_replicas(count, [&](int) {
    std::unique_lock<std::mutex> lock(drawing);
    auto sample = draw();
    lock.unlock();
    return as_far(std::move(sample));
  });
}

/// Sets a function to be called after each replica with the number done and the total (at the end,
/// count of count), by one thread at a time; an empty one switches the reports off.
void watch_replicas(std::function<void(int done, int count)> observer);

}  // namespace LSM::postproc

#endif
