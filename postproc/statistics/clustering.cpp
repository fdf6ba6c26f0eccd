// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "block_length.h"
#include "monte_carlo.h"
#include "sample.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

constexpr std::size_t fewest_times = 12;

double finite_burstiness(double r, double n) {
  const double up = std::sqrt(n + 1.0), down = std::sqrt(n - 1.0);
  return (up * r - down) / ((up - 2.0) * r + down);
}

double memory_of(const std::vector<double> &times) {
  return gsl_stats_correlation(times.data(), 1, times.data() + 1, 1, times.size() - 1);
}

AgainstChance against(double value, std::vector<double> random) {
  AgainstChance out;
  out.value = value;
  random.erase(
      std::remove_if(random.begin(), random.end(), [](double one) { return std::isnan(one); }),
      random.end());
  if (std::isnan(value) || random.empty()) return out;
  out.mean = mean_of(random);
  const auto n = static_cast<double>(random.size());
  out.deviation = n > 1.0 ? gsl_stats_sd_m(random.data(), 1, random.size(), out.mean) : 0.0;
  const auto as_far = 1.0 + std::count_if(random.begin(), random.end(), [&out](double one) {
                        return std::fabs(one - out.mean) >= std::fabs(out.value - out.mean);
                      });
  out.p = as_far / (n + 1.0);
  return out;
}

// Kolmogorov-Smirnov distance of the event times from a uniform distribution between the first and
// the last.
double departure_of(const std::vector<double> &starts) {
  return Sample(starts).distance([from = starts.front(), to = starts.back()](double start) {
    return (start - from) / (to - from);
  });
}

}  // namespace

double variation_of(const std::vector<double> &times) {
  if (times.size() < 2) return NAN;
  const double mean = mean_of(times);
  return gsl_stats_sd_with_fixed_mean(times.data(), 1, times.size(), mean) / mean;
}

double burstiness_of(double variation) { return (variation - 1.0) / (variation + 1.0); }

Clustering clustering(const std::vector<double> &times, int replicas, std::uint64_t seed) {
  Clustering out;
  if (times.size() < fewest_times || !(mean_of(times) > 0.0)) return out;
  const auto values_of = [n = static_cast<double>(times.size())](
                             double r, const std::vector<double> &series) -> std::array<double, 3> {
    return {r, finite_burstiness(r, n), memory_of(series)};
  };
  const double r = variation_of(times);
  const auto own = values_of(r, times);
  std::array<std::vector<double>, 3> chance;
  for (std::vector<double> &one : chance) one.resize(static_cast<std::size_t>(replicas));
  for_each_replica(replicas, [&](int replica) {
    Random random(seed_of_replica(seed, replica));
    std::vector<double> independent(times.size()), shuffled = times;
    for (double &time : independent) time = -std::log1p(-random.uniform());
    shuffle(shuffled, random);
    const auto found = values_of(variation_of(independent), shuffled);
    for (std::size_t i = 0; i < found.size(); ++i)
      chance[i][static_cast<std::size_t>(replica)] = found[i];
  });
  out.variation = against(own[0], chance[0]);
  out.finite_burstiness = against(own[1], chance[1]);
  out.memory = against(own[2], chance[2]);
  return out;
}

Steadiness steadiness(const std::vector<double> &starts, int replicas, std::uint64_t seed) {
  Steadiness out;
  if (starts.size() < 20) return out;
  out.departure = departure_of(starts);
  const std::vector<double> times = differences(starts);
  const std::size_t block =
      std::max<std::size_t>(1, static_cast<std::size_t>(block_length(centred(times))));
  std::vector<std::size_t> order((times.size() + block - 1) / block);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto as_far = [&](int replica) {
    Random random(seed_of_replica(seed, replica));
    std::vector<std::size_t> shuffled = order;
    shuffle(shuffled, random);
    std::vector<double> again{0.0};
    again.reserve(starts.size());
    for (const std::size_t one : shuffled)
      for (std::size_t i = one * block; i < std::min(times.size(), (one + 1) * block); ++i)
        again.push_back(again.back() + times[i]);
    return departure_of(again) >= out.departure;
  };
  if (replicas > 0) out.p = share_of_replicas(replicas, as_far);
  return out;
}

}  // namespace LSM::postproc
