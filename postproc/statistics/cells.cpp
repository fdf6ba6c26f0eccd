// SPDX-License-Identifier: GPL-2.0-or-later
#include "cells.h"

#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>

#include "replicas.h"

namespace LSM::postproc {

Cells::Cells(const std::function<double(double)> &survival, const std::vector<double> &required,
             double n, bool no_others)
    : n_(n), no_others_(no_others), edges_{required.front()} {
  double above = survival(required.front());
  for (std::size_t i = 1; i < required.size(); ++i) {
    const double above_next = survival(required[i]);
    add(survival, required[i - 1], above, required[i], above_next);
    above = above_next;
  }
  // Summed from the upper end, where the probabilities are smallest, to avoid cancellation.
  from_here_ = probabilities_;
  for (std::size_t i = size() - 1; i-- > 0;) from_here_[i] += from_here_[i + 1];
}

void Cells::add(const std::function<double(double)> &survival, double lo, double above_lo,
                double hi, double above_hi) {
  const double share = above_lo - above_hi;
  const double beyond = std::min(1.0 - above_hi, above_lo);
  const double most = std::clamp(0.05 * beyond, 1e-3 / n_, 1e-3);
  const double middle = 0.5 * (lo + hi);
  // At a jump of the distribution (of integer data, say) no cell is narrow enough: stop splitting.
  if (!no_others_ && share > most && hi - lo > 1e-9 * (1.0 + std::fabs(lo) + std::fabs(hi))) {
    const double above = survival(middle);
    add(survival, lo, above_lo, middle, above);
    add(survival, middle, above, hi, above_hi);
    return;
  }
  edges_.push_back(hi);
  centres_.push_back(middle);
  probabilities_.push_back(std::max(share, 0.0));
}

std::vector<double> Cells::count(const std::vector<double> &sorted) const {
  std::vector<double> counts(size());
  auto at = sorted.begin();
  for (std::size_t i = 0; i < size(); ++i) {
    const auto end =
        i + 1 == size() ? sorted.end() : std::lower_bound(at, sorted.end(), edges_[i + 1]);
    counts[i] = static_cast<double>(end - at);
    at = end;
  }
  return counts;
}

std::vector<double> Cells::draw(gsl_rng *rng) const {
  std::vector<double> counts(size());
  auto left = static_cast<unsigned int>(n_);
  for (std::size_t i = 0; i < size() && left > 0; ++i) {
    const double p = from_here_[i] > 0.0 ? std::min(1.0, probabilities_[i] / from_here_[i]) : 0.0;
    const unsigned int drawn = gsl_ran_binomial(rng, p, left);
    counts[i] = static_cast<double>(drawn);
    left -= drawn;
  }
  return counts;
}

double Cells::share_as_far(
    const std::vector<double> &sorted, int replicas, std::uint64_t seed,
    const std::function<double(const std::vector<double> &, double)> &distance) const {
  const double found = distance(count(sorted), NAN);
  return share_of_replicas(replicas, [&](int replica) {
    const Rng rng = generator(seed_of_replica(seed, replica));
    return !(distance(draw(rng.get()), found) < found);
  });
}

}  // namespace LSM::postproc
