// SPDX-License-Identifier: GPL-2.0-or-later
#include "block_length.h"

#include <algorithm>
#include <cmath>

#include "numerics/sum.h"

namespace LSM::postproc {

double block_length(const std::vector<double> &values) {
  const auto n = static_cast<double>(values.size());
  const double longest = std::max(1.0, n / 10.0);
  const double shortest = std::min(std::cbrt(n), longest);
  const auto covariance = [&](std::size_t lag) {
    NeumaierSum sum;
    for (std::size_t i = 0; i + lag < values.size(); ++i) sum.add(values[i] * values[i + lag]);
    return sum.value() / n;
  };
  // The correlation is taken to end where five lags in a row are not significant.
  constexpr std::size_t quiet = 5;
  const std::size_t last =
      std::min(static_cast<std::size_t>(std::ceil(std::sqrt(n))) + quiet, values.size() / 2);
  std::vector<double> r = {covariance(0)};
  if (!(r[0] > 0.0)) return shortest;
  const double significant = 2.0 * std::sqrt(std::log10(n) / n) * r[0];
  std::size_t end = 0;
  for (std::size_t lag = 1; lag <= last; ++lag) {
    r.push_back(covariance(lag));
    if (std::fabs(r[lag]) >= significant) end = lag;
    if (lag >= end + quiet) break;
  }
  // Flat-top lag window of twice that width.
  const std::size_t width = std::min(2 * std::max<std::size_t>(end, 1), last);
  while (r.size() <= width) r.push_back(covariance(r.size()));
  double spectrum = r[0], slope = 0.0;
  for (std::size_t lag = 1; lag <= width; ++lag) {
    const double t = static_cast<double>(lag) / static_cast<double>(width);
    const double weighted = 2.0 * std::min(1.0, 2.0 * (1.0 - t)) * r[lag];
    spectrum += weighted;
    slope += static_cast<double>(lag) * weighted;
  }
  // An estimate of 0 or less is a small spectrum hidden by noise: use the longest block.
  if (!(spectrum > 0.0)) return longest;
  return std::clamp(std::cbrt(1.5 * std::pow(slope / spectrum, 2) * n), shortest, longest);
}

}  // namespace LSM::postproc
