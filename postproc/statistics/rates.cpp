// SPDX-License-Identifier: GPL-2.0-or-later
#include "rates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "files/text.h"
#include "numerics/sum.h"

namespace LSM::postproc {

namespace {

/// Number of the bin of a time. 0.3 / 0.1 is 2.9999999999999996, and yet 0.3 begins a bin of 0.1.
double bin_at(double time, double width) {
  const double bins = time / width;
  return std::floor(bins + 4.0 * std::numeric_limits<double>::epsilon() * std::fabs(bins));
}

}  // namespace

std::vector<ReleaseBin> rates_of(const std::vector<Release> &events, double width) {
  if (events.empty()) return {};
  const auto [first, last] = std::minmax_element(events.begin(), events.end(),
                                                 [](auto &a, auto &b) { return a.time < b.time; });
  const double begin = bin_at(first->time, width);
  const double count = bin_at(last->time, width) - begin + 1.0;
  if (!(count <= 1e6))
    throw std::invalid_argument("times from " + text_io::number(first->time) + " to " +
                                text_io::number(last->time) + " in bins of " +
                                text_io::number(width) +
                                ", expected at most a million bins: a larger --bin");
  std::vector<ReleaseBin> bins;
  for (double n = 0.0; n < count; ++n)
    bins.push_back({(begin + n) * width, (begin + n + 1) * width});
  std::vector<NeumaierSum> sums(bins.size());
  for (const Release &event : events) {
    const auto n = static_cast<std::size_t>(bin_at(event.time, width) - begin);
    ++bins[n].events;
    sums[n].add(event.quantity);
  }
  for (std::size_t n = 0; n < bins.size(); ++n) bins[n].released = sums[n].value();
  return bins;
}

}  // namespace LSM::postproc
