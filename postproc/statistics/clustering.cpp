// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "block_length.h"
#include "replicas.h"

namespace LSM::postproc {

namespace {

constexpr std::size_t fewest_times = 12;

double finite_burstiness(double r, double n) {
  const double up = std::sqrt(n + 1.0), down = std::sqrt(n - 1.0);
  return (up * r - down) / ((up - 2.0) * r + down);
}

double memory_of(const std::vector<double> &times) {
  const std::size_t n = times.size() - 1;
  const double first = mean_of(times.data(), n), second = mean_of(times.data() + 1, n);
  NeumaierSum product, squares1, squares2;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = times[i] - first, b = times[i + 1] - second;
    product.add(a * b);
    squares1.add(a * a);
    squares2.add(b * b);
  }
  return product.value() / std::sqrt(squares1.value() * squares2.value());
}

/// Cells with equal numbers of times. The random series permute the times, and what follows a time
/// is counted by its cell. Thirds and eighths consist of whole cells.
constexpr std::size_t cells = 480, groups = 24;
static_assert(cells % groups == 0 && groups % thirds == 0 && groups % eighths == 0);

struct CelledTime {
  double time;
  std::size_t cell;
};

/// Times in the order of the series with the cell of each; equal times are in the same cell.
std::vector<CelledTime> celled(const std::vector<double> &times) {
  std::vector<double> sorted = times, edges;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k < cells; ++k) edges.push_back(sorted[sorted.size() * k / cells]);
  std::vector<CelledTime> out;
  out.reserve(times.size());
  for (const double time : times)
    out.push_back({time, static_cast<std::size_t>(
                             std::upper_bound(edges.begin(), edges.end(), time) - edges.begin())});
  return out;
}

/// Statistics of the times that follow short and long ones: the means after each third and each
/// eighth, and the distance between the times after the shortest and after the longest third.
std::vector<double> conditional_of(const std::vector<CelledTime> &series, double mean) {
  std::array<NeumaierSum, groups> sums;
  std::array<double, groups> counts{};
  std::array<std::array<double, cells>, thirds> followers{};
  for (std::size_t i = 0; i + 1 < series.size(); ++i) {
    const std::size_t group = series[i].cell / (cells / groups);
    sums[group].add(series[i + 1].time);
    counts[group] += 1.0;
    followers[series[i].cell / (cells / thirds)][series[i + 1].cell] += 1.0;
  }
  std::vector<double> out;
  for (const std::size_t parts : {thirds, eighths})
    for (std::size_t from = 0; from < groups; from += groups / parts) {
      NeumaierSum sum;
      double n = 0.0;
      for (std::size_t g = from; g < from + groups / parts; ++g) {
        sum.add(sums[g].value());
        n += counts[g];
      }
      out.push_back(sum.value() / n / mean);
    }
  std::array<double, cells> both;
  std::transform(followers.front().begin(), followers.front().end(), followers.back().begin(),
                 both.begin(), std::plus<>());
  out.push_back(distance_of_part(followers.front().data(), both.data(), cells));
  return out;
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
  out.deviation = std::sqrt(gsl_stats_tss_m(random.data(), 1, random.size(), out.mean) /
                            std::max(1.0, n - 1.0));
  const auto as_far = 1.0 + std::count_if(random.begin(), random.end(), [&out](double one) {
                        return std::fabs(one - out.mean) >= std::fabs(out.value - out.mean);
                      });
  out.p = as_far / (n + 1.0);
  return out;
}

/// Kolmogorov-Smirnov distance of the event times from a uniform distribution between the first and
/// the last.
double departure_of(const std::vector<double> &starts) {
  const double n = static_cast<double>(starts.size()), from = starts.front();
  double most = 0.0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double line = (starts[i] - from) / (starts.back() - from);
    const double below = static_cast<double>(i) / n;
    most = std::max({most, std::fabs(line - below), std::fabs(line - below - 1.0 / n)});
  }
  return most;
}

std::size_t block_of(const std::vector<double> &values) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(block_length(centred(values))));
}

std::vector<Stretch> steady_stretches(const std::vector<double> &starts, double tolerance,
                                      std::int64_t fewest) {
  constexpr std::size_t edges = 120, fine = 10, most = 4;
  auto numbers = cumulative_numbers(starts, edges * fine);
  numbers.front().second = 0;
  const auto count = [&numbers](std::size_t i, std::size_t j) {
    return static_cast<double>(numbers[j].second - numbers[i].second);
  };
  std::vector<Stretch> candidates, chosen;
  for (std::size_t i = 0; i < edges * fine; i += fine)
    for (std::size_t j = i + fine; j <= edges * fine; j += fine) {
      Stretch one{numbers[i].first, numbers[j].first, numbers[j].second - numbers[i].second, 0.0};
      if (one.n < fewest) continue;
      // Distance from a straight line between the ends of the stretch, at the grid points.
      for (std::size_t k = i; k <= j; ++k)
        one.departure = std::max(
            one.departure, std::fabs(count(i, k) / count(i, j) -
                                     static_cast<double>(k - i) / static_cast<double>(j - i)));
      if (one.departure <= tolerance) candidates.push_back(one);
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Stretch &a, const Stretch &b) { return a.n > b.n; });
  for (const Stretch &one : candidates) {
    if (chosen.size() == most) break;
    if (std::none_of(chosen.begin(), chosen.end(), [&one](const Stretch &other) {
          return one.from < other.to && other.from < one.to;
        }))
      chosen.push_back(one);
  }
  return chosen;
}

}  // namespace

std::vector<std::pair<double, std::int64_t>> cumulative_numbers(const std::vector<double> &starts,
                                                                int points) {
  const double from = starts.front(), to = starts.back();
  std::vector<std::pair<double, std::int64_t>> out;
  for (int i = 0; i <= points; ++i) {
    const double time = i == points ? to : from + (to - from) * i / points;
    out.emplace_back(time, std::upper_bound(starts.begin(), starts.end(), time) - starts.begin());
  }
  return out;
}

double variation_of(const std::vector<double> &times) {
  if (times.size() < 2) return NAN;
  const double mean = mean_of(times);
  NeumaierSum squares;
  for (const double time : times) squares.add((time - mean) * (time - mean));
  return std::sqrt(squares.value() / static_cast<double>(times.size())) / mean;
}

double burstiness_of(double variation) { return (variation - 1.0) / (variation + 1.0); }

Clustering clustering(const std::vector<double> &times, int replicas, std::uint64_t seed) {
  Clustering out;
  if (times.size() < fewest_times || !(mean_of(times) > 0.0)) return out;
  const auto n = static_cast<double>(times.size());
  const double r = variation_of(times);
  out.burstiness = burstiness_of(r);

  const std::vector<CelledTime> series = celled(times);
  const double mean = mean_of(times);
  std::vector<AgainstChance *> numbers = {&out.variation, &out.finite_burstiness, &out.memory};
  for (AgainstChance &one : out.after) numbers.push_back(&one);
  for (AgainstChance &one : out.after_eighth) numbers.push_back(&one);
  numbers.push_back(&out.after_distance);
  const auto values_of = [&](double ratio, const std::vector<CelledTime> &ordered) {
    std::vector<double> in_order;
    in_order.reserve(ordered.size());
    for (const CelledTime &one : ordered) in_order.push_back(one.time);
    std::vector<double> values = {ratio, finite_burstiness(ratio, n), memory_of(in_order)};
    const std::vector<double> conditional = conditional_of(ordered, mean);
    values.insert(values.end(), conditional.begin(), conditional.end());
    return values;
  };
  const std::vector<double> own = values_of(r, series);
  std::vector<std::vector<double>> found(static_cast<std::size_t>(replicas));
  for_each_replica(replicas, [&](int replica) {
    Random random(seed_of_replica(seed, replica));
    std::vector<double> independent(times.size());
    for (double &time : independent) time = -std::log1p(-random.uniform());
    std::vector<CelledTime> shuffled = series;
    shuffle(shuffled, random);
    found[static_cast<std::size_t>(replica)] = values_of(variation_of(independent), shuffled);
  });
  std::vector<std::vector<double>> chance(numbers.size());
  for (const std::vector<double> &one : found)
    for (std::size_t i = 0; i < one.size(); ++i) chance[i].push_back(one[i]);
  for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i] = against(own[i], chance[i]);
  return out;
}

std::array<std::vector<double>, thirds> times_after_thirds(const std::vector<double> &times) {
  std::array<std::vector<double>, thirds> out;
  if (times.size() < 2) return out;
  const std::vector<CelledTime> series = celled(times);
  for (std::size_t i = 0; i + 1 < series.size(); ++i)
    out[series[i].cell / (cells / thirds)].push_back(series[i + 1].time);
  return out;
}

Steadiness steadiness(const std::vector<double> &starts, double tolerance, std::int64_t fewest,
                      int replicas, std::uint64_t seed) {
  Steadiness out;
  if (starts.size() < 20) return out;
  out.whole = {starts.front(), starts.back(), static_cast<std::int64_t>(starts.size()),
               departure_of(starts)};
  const std::vector<double> times = differences(starts);
  const std::size_t block = block_of(times);
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
    return departure_of(again) >= out.whole.departure;
  };
  if (replicas > 0) out.p = share_of_replicas(replicas, as_far);
  out.steady = steady_stretches(starts, tolerance, fewest);
  return out;
}

}  // namespace LSM::postproc
