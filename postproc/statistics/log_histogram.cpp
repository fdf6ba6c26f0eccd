// SPDX-License-Identifier: GPL-2.0-or-later
#include "log_histogram.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace LSM::postproc {

LogHistogram::LogHistogram(double factor) : factor_(factor), log_factor_(std::log(factor)) {
  if (!(factor >= 1.0001 && std::isfinite(factor)))
    throw std::invalid_argument("log-binning: factor " + std::to_string(factor) +
                                ", expected a finite number of at least 1.0001");
}

double LogHistogram::edge(std::int64_t n) const {
  return std::pow(factor_, static_cast<double>(n));
}

void LogHistogram::add(double value) {
  if (!(value > 0.0 && std::isfinite(value))) {
    ++outside_;
    return;
  }
  // The quotient of logarithms can be off by one next to an edge; the edges themselves decide.
  auto n = static_cast<std::int64_t>(std::floor(std::log(value) / log_factor_));
  if (value < edge(n))
    --n;
  else if (value >= edge(n + 1))
    ++n;
  ++counts_[n];
  ++total_;
}

std::vector<LogBin> LogHistogram::bins(double threshold, double upto) const {
  constexpr double rounding = 1e-9;
  std::vector<LogBin> result;
  double samples = 0.0;
  std::int64_t next = 0;
  for (const auto &[n, count] : counts_) {
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
