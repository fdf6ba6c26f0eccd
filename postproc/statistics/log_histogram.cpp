// SPDX-License-Identifier: GPL-2.0-or-later
#include "log_histogram.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace LSM::postproc {

std::vector<LogBin> log_histogram(const std::vector<double> &values, double factor,
                                  double threshold, double upto, double origin) {
  if (!(factor >= 1.0001 && std::isfinite(factor)))
    throw std::invalid_argument("log-binning: factor " + std::to_string(factor) +
                                ", expected a finite number of at least 1.0001");
  const auto edge = [=](std::int64_t n) {
    return origin * std::pow(factor, static_cast<double>(n));
  };
  const double log_factor = std::log(factor);
  std::map<std::int64_t, std::int64_t> counts;
  for (const double value : values) {
    if (!(value > 0.0 && std::isfinite(value))) continue;
    // Next to an edge, the quotient of the logarithms can be off by one; compare with the edges.
    auto n = static_cast<std::int64_t>(std::floor(std::log(value / origin) / log_factor));
    if (value < edge(n))
      --n;
    else if (value >= edge(n + 1))
      ++n;
    ++counts[n];
  }
  constexpr double rounding = 1e-9;
  std::vector<LogBin> result;
  double samples = 0.0;
  std::int64_t next = 0;
  for (const auto &[n, count] : counts) {
    if (edge(n) < threshold * (1.0 - rounding) || edge(n + 1) > upto * (1.0 + rounding)) continue;
    if (result.empty()) next = n;
    for (; next <= n; ++next)
      result.push_back({edge(next), edge(next + 1), std::sqrt(edge(next) * edge(next + 1)),
                        next == n ? count : 0, 0.0, 0.0});
    samples += static_cast<double>(count);
  }
  for (LogBin &bin : result) {
    const double scale = 1.0 / (samples * (bin.hi - bin.lo));
    const auto count = static_cast<double>(bin.count);
    bin.density = count * scale;
    bin.error = std::sqrt(count) * scale;
  }
  return result;
}

}  // namespace LSM::postproc
