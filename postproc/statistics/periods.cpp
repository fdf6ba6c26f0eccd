// SPDX-License-Identifier: GPL-2.0-or-later
#include "periods.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "replicas.h"

namespace LSM::postproc {

namespace {

constexpr double turn = 6.283185307179586;

struct Resultant {
  double x = 0.0, y = 0.0;
  double square() const { return x * x + y * y; }
};

Resultant resultant(const std::vector<double> &times, const std::vector<double> &weights,
                    double period) {
  NeumaierSum x, y;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double angle = turn * std::fmod(times[i], period) / period;
    x.add(weights[i] * std::cos(angle));
    y.add(weights[i] * std::sin(angle));
  }
  return {x.value(), y.value()};
}

double sum_of_squares(const std::vector<double> &values) {
  NeumaierSum sum;
  for (const double value : values) sum.add(value * value);
  return sum.value();
}

void check(const std::vector<double> &times, double period) {
  if (!(period > 0.0) || !std::isfinite(period))
    throw std::invalid_argument(fmt::format("period {}, expected a positive number", period));
  if (times.size() < 10)
    throw std::invalid_argument(
        fmt::format("a period of {} events, expected at least 10", times.size()));
}

std::vector<double> binned(const std::vector<double> &times, const std::vector<double> &weights,
                           double from, double bin, std::size_t count) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double at = (times[i] - from) / bin;
    if (at >= 0.0 && at < static_cast<double>(count))
      out[static_cast<std::size_t>(at)] += weights[i];
  }
  return out;
}

}  // namespace

double effective_number(const std::vector<double> &weights) {
  const double sum = sum_pairwise(weights.data(), weights.size());
  return sum * sum / sum_of_squares(weights);
}

double rayleigh_z(const std::vector<double> &times, const std::vector<double> &weights,
                  double period) {
  return resultant(times, weights, period).square() / sum_of_squares(weights);
}

PeriodTest test_period(const std::vector<double> &times, const std::vector<double> &weights,
                       double period, int replicas, std::uint64_t seed) {
  check(times, period);
  PeriodTest test;
  test.period = period;
  const Resultant sum = resultant(times, weights, period);
  const double squares = sum_of_squares(weights);
  test.z = sum.square() / squares;
  test.phase = std::atan2(sum.y, sum.x) / turn;
  if (test.phase < 0.0) test.phase += 1.0;
  double total = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double phase = std::fmod(times[i], period) / period;
    if (phase < 0.0) phase += 1.0;
    test.tenths[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * phase))] += weights[i];
    total += weights[i];
  }
  for (double &tenth : test.tenths) tenth *= 10.0 / total;
  const double p = share_of_replicas(replicas, [&](int replica) {
    Random random(seed_of_replica(seed, replica));
    double x = 0.0, y = 0.0;
    for (const double weight : weights) {
      const double angle = turn * random.uniform();
      x += weight * std::cos(angle);
      y += weight * std::sin(angle);
    }
    return (x * x + y * y) / squares >= test.z;
  });
  test.p = share_of(p, replicas);
  return test;
}

PeriodScan scan_periods(const std::vector<double> &times, const std::vector<double> &weights,
                        double shortest, double longest) {
  check(times, shortest);
  PeriodScan scan;
  const double duration = times.back() - times.front();
  const auto first = static_cast<std::int64_t>(std::ceil(duration / longest));
  const auto last = static_cast<std::int64_t>(std::floor(duration / shortest));
  for (std::int64_t turns = std::max<std::int64_t>(first, 1); turns <= last; ++turns) {
    scan.periods.push_back(duration / static_cast<double>(turns));
    scan.z.push_back(rayleigh_z(times, weights, scan.periods.back()));
  }
  if (!scan.z.empty())
    scan.by_chance = -std::log1p(-std::pow(0.95, 1.0 / static_cast<double>(scan.periods.size())));
  return scan;
}

Coincidence coincidence(const std::vector<double> &first_times,
                        const std::vector<double> &first_weights,
                        const std::vector<double> &second_times,
                        const std::vector<double> &second_weights, double bin, int replicas,
                        std::uint64_t seed) {
  Coincidence found;
  if (first_times.empty() || second_times.empty())
    throw std::invalid_argument("two catalogues at equal times: one has no events");
  const double from = std::max(first_times.front(), second_times.front());
  const double bins = std::floor((std::min(first_times.back(), second_times.back()) - from) / bin);
  if (!(bins >= 20.0))
    throw std::invalid_argument(fmt::format(
        "two catalogues at equal times: fewer than 20 bins of {} in common, expected more", bin));
  const auto count = static_cast<std::size_t>(bins);
  found.bins = static_cast<std::int64_t>(count);
  const std::vector<double> a = centred(binned(first_times, first_weights, from, bin, count));
  const std::vector<double> b = centred(binned(second_times, second_weights, from, bin, count));
  const double scale = std::sqrt(sum_of_squares(a) * sum_of_squares(b));
  const auto shifted = [&](std::size_t by) {
    NeumaierSum sum;
    for (std::size_t i = 0; i < count; ++i) sum.add(a[i] * b[(i + by) % count]);
    return sum.value() / scale;
  };
  found.correlation = shifted(0);
  const double least = found.correlation * (1.0 - 1e-12);
  const double p = share_of_replicas(replicas, [&](int replica) {
    Random random(seed_of_replica(seed, replica));
    return shifted(1 + draw_index(random, count - 1)) >= least;
  });
  found.p = share_of(p, replicas);
  return found;
}

}  // namespace LSM::postproc
