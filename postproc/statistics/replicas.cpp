// SPDX-License-Identifier: GPL-2.0-or-later
#include "replicas.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "numerics/random.h"

namespace LSM::postproc {

namespace {

std::function<void(int, int)> watcher;

}  // namespace

std::uint64_t seed_of_replica(std::uint64_t seed, int replica) {
  return splitmix64(splitmix64(seed) + splitmix64_step * static_cast<std::uint64_t>(replica));
}

Rng generator(std::uint64_t seed) {
  Rng rng(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(rng.get(), static_cast<unsigned long>(seed));
  return rng;
}

void watch_replicas(std::function<void(int, int)> observer) { watcher = std::move(observer); }

void for_each_replica(int count, const std::function<void(int)> &task) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  int done = 0;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) {
      std::exception_ptr caught;
      try {
        task(k);
      } catch (...) {
        caught = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex);
      if (caught && !failure) {
        failure = caught;
        next = count;
      }
      if (watcher) watcher(++done, count);
    }
  };
  std::vector<std::thread> pool;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  for (int k = 1; k < std::min(cores, count); ++k) pool.emplace_back(work);
  work();
  for (std::thread &thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

double share_of_replicas(int count, const std::function<bool(int)> &as_far) {
  std::atomic<int> far{0};
  for_each_replica(count, [&](int replica) {
    if (as_far(replica)) ++far;
  });
  return (far + 1.0) / (count + 1.0);
}

}  // namespace LSM::postproc
