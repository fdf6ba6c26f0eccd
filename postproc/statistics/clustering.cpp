// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "finite_size.h"
#include "lsm_random.h"
#include "lsm_sum.h"
#include "two_sample.h"

namespace LSM::postproc {

namespace {

constexpr std::size_t fewest_times = 12;

double mean_of(const std::vector<double> &values) {
  return sum_pairwise(values.data(), values.size()) / static_cast<double>(values.size());
}

/// Standard deviation (of the series, not of a law behind it) over mean.
double ratio_of(const std::vector<double> &times) {
  const double mean = mean_of(times);
  NeumaierSum squares;
  for (const double time : times) squares.add((time - mean) * (time - mean));
  return std::sqrt(squares.value() / static_cast<double>(times.size())) / mean;
}

double finite_burstiness(double r, double n) {
  const double up = std::sqrt(n + 1.0), down = std::sqrt(n - 1.0);
  return (up * r - down) / ((up - 2.0) * r + down);
}

/// Correlation of each value with the next.
double memory_of(const std::vector<double> &times) {
  const std::size_t n = times.size() - 1;
  const double first = sum_pairwise(times.data(), n) / static_cast<double>(n),
               second = sum_pairwise(times.data() + 1, n) / static_cast<double>(n);
  NeumaierSum product, squares1, squares2;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = times[i] - first, b = times[i + 1] - second;
    product.add(a * b);
    squares1.add(a * a);
    squares2.add(b * b);
  }
  return product.value() / std::sqrt(squares1.value() * squares2.value());
}

/// Mean of the times that follow each third of the times, over the mean of all.
std::array<double, 3> conditional_means(const std::vector<double> &times, double shorter,
                                        double longer) {
  std::array<NeumaierSum, 3> sums;
  std::array<double, 3> counts{};
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const std::size_t third = times[i] < shorter ? 0 : times[i] < longer ? 1 : 2;
    sums[third].add(times[i + 1]);
    counts[third] += 1.0;
  }
  const double mean = mean_of(times);
  return {sums[0].value() / counts[0] / mean, sums[1].value() / counts[1] / mean,
          sums[2].value() / counts[2] / mean};
}

AgainstChance against(double value, const std::vector<double> &random) {
  AgainstChance out;
  out.value = value;
  out.mean = mean_of(random);
  NeumaierSum squares;
  double as_far = 1.0;
  for (const double one : random) {
    squares.add((one - out.mean) * (one - out.mean));
    if (std::fabs(one - out.mean) >= std::fabs(value - out.mean)) as_far += 1.0;
  }
  const auto n = static_cast<double>(random.size());
  out.deviation = std::sqrt(squares.value() / std::max(1.0, n - 1.0));
  out.p = as_far / (n + 1.0);
  return out;
}

template <class T>
void shuffle(std::vector<T> &values, Random &random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1],
              values[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
}

/// Largest departure of events from a steady rate between from and to, over their number.
double departure_of(const std::vector<double> &starts, double from, double to) {
  const auto n = static_cast<double>(starts.size());
  double most = 0.0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double line = (starts[i] - from) / (to - from), below = static_cast<double>(i) / n;
    most = std::max({most, std::fabs(line - below), std::fabs(line - below - 1.0 / n)});
  }
  return most;
}

std::vector<double> centred(std::vector<double> values) {
  const double mean = mean_of(values);
  for (double &value : values) value -= mean;
  return values;
}

std::vector<double> rescaled(std::vector<double> values) {
  const double mean = mean_of(values);
  for (double &value : values) value /= mean;
  return values;
}

/// Blocks of consecutive values from random places, the series taken as a ring.
std::vector<double> resampled(const std::vector<double> &values, std::size_t block,
                              Random &random) {
  std::vector<double> out;
  while (out.size() < values.size()) {
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()));
    for (std::size_t i = 0; i < block && out.size() < values.size(); ++i)
      out.push_back(values[(at + i) % values.size()]);
  }
  return out;
}

std::size_t block_of(const std::vector<double> &values) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(block_length(centred(values))));
}

/// Cumulative number of events at steps of time from first to last.
class Cumulative {
 public:
  Cumulative(const std::vector<double> &starts, std::size_t steps)
      : from_(starts.front()),
        step_((starts.back() - starts.front()) / static_cast<double>(steps)) {
    for (std::size_t i = 0; i <= steps; ++i)
      counts_.push_back(static_cast<double>(
          std::upper_bound(starts.begin(), starts.end(), time(i)) - starts.begin()));
    counts_.front() = 0.0;
  }
  double time(std::size_t i) const { return from_ + step_ * static_cast<double>(i); }
  double count(std::size_t i, std::size_t j) const { return counts_[j] - counts_[i]; }
  /// Departure from a straight line between two steps, seen at the steps.
  double departure(std::size_t i, std::size_t j) const {
    double most = 0.0;
    const double n = count(i, j);
    for (std::size_t k = i; k <= j; ++k)
      most = std::max(most, std::fabs(count(i, k) / n -
                                      static_cast<double>(k - i) / static_cast<double>(j - i)));
    return most;
  }

 private:
  double from_, step_;
  std::vector<double> counts_;
};

std::vector<Stretch> steady_stretches(const std::vector<double> &starts, double tolerance,
                                      std::int64_t fewest) {
  constexpr std::size_t edges = 120, fine = 10, most = 4;
  const Cumulative cumulative(starts, edges * fine);
  std::vector<Stretch> candidates, chosen;
  for (std::size_t i = 0; i < edges; ++i)
    for (std::size_t j = i + 1; j <= edges; ++j) {
      Stretch one;
      one.n = static_cast<std::int64_t>(cumulative.count(i * fine, j * fine));
      if (one.n < fewest) continue;
      one.departure = cumulative.departure(i * fine, j * fine);
      if (one.departure > tolerance) continue;
      one.from = cumulative.time(i * fine);
      one.to = cumulative.time(j * fine);
      candidates.push_back(one);
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

Clustering clustering(const std::vector<double> &times, int replicas, std::uint64_t seed) {
  Clustering out;
  out.n = static_cast<std::int64_t>(times.size());
  if (times.size() < fewest_times || !(mean_of(times) > 0.0)) return out;
  const auto n = static_cast<double>(times.size());
  const double r = ratio_of(times);
  out.burstiness = (r - 1.0) / (r + 1.0);

  std::vector<double> sorted = times;
  std::sort(sorted.begin(), sorted.end());
  const double shorter = sorted[times.size() / 3], longer = sorted[2 * times.size() / 3];
  const std::array<double, 3> after = conditional_means(times, shorter, longer);

  Random random(seed);
  std::vector<double> series = times, independent(times.size()), ratios, bursts, memories;
  std::array<std::vector<double>, 3> means;
  for (int k = 0; k < replicas; ++k) {
    for (double &time : independent) time = -std::log1p(-random.uniform());
    ratios.push_back(ratio_of(independent));
    bursts.push_back(finite_burstiness(ratios.back(), n));
    shuffle(series, random);
    memories.push_back(memory_of(series));
    const std::array<double, 3> one = conditional_means(series, shorter, longer);
    for (std::size_t i = 0; i < means.size(); ++i) means[i].push_back(one[i]);
  }
  out.variation = against(r, ratios);
  out.finite_burstiness = against(finite_burstiness(r, n), bursts);
  out.memory = against(memory_of(times), memories);
  for (std::size_t i = 0; i < means.size(); ++i) out.after[i] = against(after[i], means[i]);
  return out;
}

Steadiness steadiness(const std::vector<double> &starts, double tolerance, std::int64_t fewest,
                      int replicas, std::uint64_t seed) {
  Steadiness out;
  if (starts.size() < 20) return out;
  out.whole = {starts.front(), starts.back(), static_cast<std::int64_t>(starts.size()),
               departure_of(starts, starts.front(), starts.back())};
  std::vector<double> times;
  for (std::size_t i = 1; i < starts.size(); ++i) times.push_back(starts[i] - starts[i - 1]);
  const std::size_t block = block_of(times);
  std::vector<std::size_t> order((times.size() + block - 1) / block);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  double as_far = 1.0;
  for (int k = 0; k < replicas; ++k) {
    shuffle(order, random);
    std::vector<double> again{0.0};
    for (const std::size_t one : order)
      for (std::size_t i = one * block; i < std::min(times.size(), (one + 1) * block); ++i)
        again.push_back(again.back() + times[i]);
    if (departure_of(again, again.front(), again.back()) >= out.whole.departure) as_far += 1.0;
  }
  if (replicas > 0) out.p = as_far / (replicas + 1.0);
  out.steady = steady_stretches(starts, tolerance, fewest);
  return out;
}

AroundLarge around_large(const std::vector<double> &starts, const std::vector<double> &sizes,
                         double share) {
  AroundLarge out;
  if (starts.size() < fewest_times) return out;
  const double mean = (starts.back() - starts.front()) / static_cast<double>(starts.size() - 1);
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end(), std::greater<double>());
  const double least =
      sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (sizes[i] < least) continue;
    ++out.large;
    for (std::size_t j = i; j-- > 0 && starts[i] - starts[j] < mean;) before += 1.0;
    for (std::size_t j = i + 1; j < starts.size() && starts[j] - starts[i] < mean; ++j)
      after += 1.0;
  }
  out.before = before / static_cast<double>(out.large);
  out.after = after / static_cast<double>(out.large);
  return out;
}

RescaledDistance rescaled_distance(const std::vector<double> &first,
                                   const std::vector<double> &second, int replicas,
                                   std::uint64_t seed) {
  RescaledDistance out;
  if (first.size() < fewest_times || second.size() < fewest_times) return out;
  out.distance = two_sample_distance(rescaled(first), rescaled(second));
  const std::size_t block1 = block_of(first), block2 = block_of(second);
  Random random(seed);
  std::vector<double> again;
  for (int k = 0; k < replicas; ++k)
    again.push_back(two_sample_distance(rescaled(resampled(first, block1, random)),
                                        rescaled(resampled(second, block2, random))));
  if (replicas > 1) out.error = against(out.distance, again).deviation;
  return out;
}

}  // namespace LSM::postproc
