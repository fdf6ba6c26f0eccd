// SPDX-License-Identifier: GPL-2.0-or-later
#include "monte_carlo.h"

#include <gsl/gsl_randist.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "numerics/random.h"

namespace LSM::postproc {

namespace {

// Cells [edge i, edge i + 1) and the probability of a law in each.
class CellsOfLaw {
 public:
  CellsOfLaw(const FittedLaw &law, double n) : law_(law), n_(n), edges_{law.edges.front()} {
    double above = law.survival(edges_[0]);
    for (std::size_t i = 1; i < law.edges.size(); ++i) {
      const double above_next = law.survival(law.edges[i]);
      add(law.edges[i - 1], above, law.edges[i], above_next);
      above = above_next;
    }
    // Summed from the upper end, where the probabilities are smallest, to avoid cancellation.
    from_here_ = probabilities_;
    for (std::size_t i = centres_.size() - 1; i-- > 0;) from_here_[i] += from_here_[i + 1];
  }

  // Values beyond the ends are counted in the outermost cells.
  Sample count(const std::vector<double> &sorted) const {
    std::vector<double> counts(centres_.size());
    auto at = sorted.begin();
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto end =
          i + 1 == counts.size() ? sorted.end() : std::lower_bound(at, sorted.end(), edges_[i + 1]);
      counts[i] = static_cast<double>(end - at);
      at = end;
    }
    return {edges_, centres_, counts};
  }

  // A sample of the same size drawn from the law.
  Sample draw(gsl_rng *rng) const {
    std::vector<double> counts(centres_.size());
    auto left = static_cast<unsigned int>(n_);
    for (std::size_t i = 0; i < counts.size() && left > 0; ++i) {
      const double p = from_here_[i] > 0.0 ? std::min(1.0, probabilities_[i] / from_here_[i]) : 0.0;
      const unsigned int drawn = gsl_ran_binomial(rng, p, left);
      counts[i] = static_cast<double>(drawn);
      left -= drawn;
    }
    return {edges_, centres_, counts};
  }

 private:
  void add(double lo, double above_lo, double hi, double above_hi) {
    const double share = above_lo - above_hi;
    const double beyond = std::min(1.0 - above_hi, above_lo);
    const double most = std::clamp(0.05 * beyond, 1e-3 / n_, 1e-3);
    const double middle = 0.5 * (lo + hi);
    // At a jump of the distribution (of integer data, say) no cell is narrow enough: stop
    // splitting.
    if (!law_.in_bins && share > most && hi - lo > 1e-9 * (1.0 + std::fabs(lo) + std::fabs(hi))) {
      const double above = law_.survival(middle);
      add(lo, above_lo, middle, above);
      add(middle, above, hi, above_hi);
      return;
    }
    edges_.push_back(hi);
    centres_.push_back(middle);
    probabilities_.push_back(std::max(share, 0.0));
  }

  const FittedLaw &law_;
  double n_;
  std::vector<double> edges_, centres_, probabilities_, from_here_;
};

}  // namespace

std::uint64_t seed_of_replica(std::uint64_t seed, int replica) {
  return splitmix64(splitmix64(seed) + splitmix64_step * static_cast<std::uint64_t>(replica));
}

Rng generator(std::uint64_t seed) {
  Rng rng(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  gsl_rng_set(rng.get(), static_cast<unsigned long>(seed));
  return rng;
}

void for_each_replica(int count, const std::function<void(int)> &task) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (int k = next++; k < count; k = next++) try {
        task(k);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
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

double share_of_worse_fits(const FittedLaw &law, const std::vector<double> &sorted, double distance,
                           int replicas, std::uint64_t seed) {
  const auto is_worse = [&](Sample sample) {
    const FittedLaw::Function cdf = law.refit(sample);
    sample.sort();
    return !cdf || sample.is_as_far(cdf, distance);
  };
  if (law.in_bins || sorted.size() > largest_exact_sample) {
    const CellsOfLaw cells(law, static_cast<double>(sorted.size()));
    const Sample data = cells.count(sorted);
    const FittedLaw::Function cdf = law.refit(data);
    distance = cdf ? data.distance(cdf) : HUGE_VAL;
    return share_of_replicas(replicas, [&](int replica) {
      return is_worse(cells.draw(generator(seed_of_replica(seed, replica)).get()));
    });
  }
  const Rng rng = generator(seed);
  std::mutex drawing;
  return share_of_replicas(replicas, [&](int) {
    std::unique_lock<std::mutex> lock(drawing);
    Sample sample(law.draw(rng.get()));
    lock.unlock();
    return is_worse(std::move(sample));
  });
}

}  // namespace LSM::postproc
