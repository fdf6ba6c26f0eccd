// SPDX-License-Identifier: GPL-2.0-or-later
/// \file replicas.h
/// The replicas of Monte Carlo tests: several at a time, with random numbers that do not depend on
/// the number of cores.
#ifndef LSM_POSTPROC_REPLICAS_H
#define LSM_POSTPROC_REPLICAS_H

#include <gsl/gsl_rng.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>

#include "gsl_owners.h"

namespace LSM::postproc {

/// Samples of up to this many values are used as they are by tests that refit them; larger ones by
/// cells (see cells.h), so that a refit costs no more.
constexpr std::int64_t largest_exact_sample = 8192;

/// Seed of one replica; neighbouring seeds and replicas have nothing in common.
std::uint64_t seed_of_replica(std::uint64_t seed, int replica);

using Rng = Gsl<gsl_rng>;

/// Mersenne Twister.
Rng generator(std::uint64_t seed);

/// Calls task(0) to task(count - 1) on all cores that the process may use. \throws what the first
/// task throws that does
void for_each_replica(int count, const std::function<void(int)> &task);

/// (k + 1) / (count + 1) with the number k of replicas that are as far off as the data.
double share_of_replicas(int count, const std::function<bool(int)> &as_far);
/// The same for samples that draw() gives one after the other, on any thread.
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

/// Called between replicas with the number done and the total, by one thread at a time; at the end
/// count of count. Empty: no report.
void watch_replicas(std::function<void(int done, int count)> observer);

}  // namespace LSM::postproc

#endif
