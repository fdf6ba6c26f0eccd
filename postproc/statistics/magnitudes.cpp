// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitudes.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "files/text.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

constexpr std::int64_t fewest_magnitudes = 10;

// b from all values, which are at or above `least`; `what` names them in messages.
BValue estimate(const std::vector<double> &values, double least, double width, const char *what) {
  BValue result;
  result.n = static_cast<std::int64_t>(values.size());
  if (result.n < fewest_magnitudes)
    return without_numbers(result, std::to_string(result.n) + " " + what + ", at least " +
                                       std::to_string(fewest_magnitudes) + " needed");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return without_numbers(result, std::string("all ") + what + " are equal");
  const double n = static_cast<double>(values.size());
  NeumaierSum excess;
  for (const double value : values) excess.add(value - least);
  const double mean = excess.value() / n;
  const double squares = gsl_stats_tss_m(values.data(), 1, values.size(), least + mean);
  const double ln10 = std::log(10.0);
  result.degenerate = false;
  result.b = width > 0.0 ? std::log1p(width / mean) / (ln10 * width) : 1.0 / (ln10 * mean);
  result.error = ln10 * result.b * result.b * std::sqrt(squares / (n * (n - 1.0)));
  return result;
}

std::vector<double> complete(const std::vector<double> &magnitudes, double completeness,
                             double width) {
  std::vector<double> kept;
  for (const double m : magnitudes)
    if (reaches(m, completeness - 0.5 * width)) kept.push_back(m);
  return kept;
}

}  // namespace

double MagnitudeScale::of(double size) const { return slope * std::log10(size) + constant; }

double size_of_magnitude(double magnitude) { return std::pow(10.0, 1.5 * magnitude); }

double magnitude_of_size(double size) { return std::log10(size) / 1.5; }

double binned(double magnitude, double width) {
  return width > 0.0 ? nearest_decimal(bin_of(magnitude, width) * width) : magnitude;
}

MagnitudeBins recognized_bins(const std::vector<double> &magnitudes) {
  const auto n = static_cast<double>(magnitudes.size());
  const auto share = [&](double width) {
    const auto of_bins = [width](double m) { return std::fabs(m - binned(m, width)) < 1e-6; };
    return static_cast<double>(std::count_if(magnitudes.begin(), magnitudes.end(), of_bins)) / n;
  };
  MagnitudeBins bins;
  if (magnitudes.empty()) return bins;
  const double beyond_chance = std::max(0.25, 0.1 + 1.5 / std::sqrt(n));
  for (const double width : {0.1, 0.01, 0.001}) {
    bins.share = share(width);
    if (bins.share < 0.95) {
      if (bins.wider > 0.0 || bins.share <= beyond_chance) continue;
      bins.wider = width;
      bins.share_of_wider = bins.share;
      continue;
    }
    bins.width = width;
    if (bins.share == 1.0 && n >= 20.0)
      for (const double times : {2.0, 5.0, 10.0})
        if (const double several = nearest_decimal(times * width); share(several) == 1.0)
          bins.width = several;
    break;
  }
  return bins;
}

BValue b_value(const std::vector<double> &magnitudes, double completeness, double width) {
  return estimate(complete(magnitudes, completeness, width), completeness, width, "magnitudes");
}

BValue b_positive(const std::vector<double> &magnitudes, double completeness, double width) {
  std::vector<double> up;
  for (const double step : differences(complete(magnitudes, completeness, width)))
    // Continuous magnitudes (width 0) may be equal; a difference of 0 is not positive.
    if (step >= 0.5 * width && step > 0.0) up.push_back(step);
  return estimate(up, width, width, "positive differences of magnitudes");
}

double maximum_curvature(const std::vector<double> &magnitudes, double width) {
  const std::vector<MagnitudeCount> counts = magnitude_counts(magnitudes, width);
  const auto fullest = std::max_element(counts.begin(), counts.end(),
                                        [](auto &a, auto &b) { return a.count < b.count; });
  return fullest == counts.end() ? NAN : nearest_decimal(fullest->magnitude + 0.2);
}

std::vector<MagnitudeCount> magnitude_counts(const std::vector<double> &magnitudes, double width) {
  std::map<std::int64_t, std::int64_t> counts;
  constexpr double most = 1e5;
  const auto [low, high] = std::minmax_element(magnitudes.begin(), magnitudes.end());
  if (!magnitudes.empty() &&
      (!((*high - *low) / width < most) || !(std::fabs(*high) / width < 1e15)))
    throw std::invalid_argument("magnitudes from " + text::number(*low) + " to " +
                                text::number(*high) + " in bins of " + text::number(width) +
                                ", expected fewer than 1e5 bins: a smaller --magnitude-slope or "
                                "wider bins");
  for (const double m : magnitudes) ++counts[static_cast<std::int64_t>(bin_of(m, width))];
  std::vector<MagnitudeCount> out;
  if (counts.empty()) return out;
  auto rest = static_cast<std::int64_t>(magnitudes.size());
  for (std::int64_t bin = counts.begin()->first; bin <= counts.rbegin()->first; ++bin) {
    const auto found = counts.find(bin);
    const std::int64_t count = found == counts.end() ? 0 : found->second;
    out.push_back({nearest_decimal(static_cast<double>(bin) * width), count, rest});
    rest -= count;
  }
  return out;
}

}  // namespace LSM::postproc
