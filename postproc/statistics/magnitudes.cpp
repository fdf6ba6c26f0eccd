// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitudes.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

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

constexpr double most_in_bins = 0.95;  // of the magnitudes, for bins to be recognized
constexpr double least_width = 0.001;  // of bins that are recognized

// The widest bins that hold most of 20 or more magnitudes, of which most are multiples of a unit.
std::optional<MagnitudeBins> widest_bins(const std::vector<double> &magnitudes, double unit) {
  if (magnitudes.size() < 20) return {};
  std::map<std::int64_t, std::int64_t> counts;
  for (const double m : magnitudes)
    if (MagnitudeBins{unit}.has_centre(m)) ++counts[std::llround(m / unit)];
  std::vector<std::pair<std::int64_t, std::int64_t>> often(counts.begin(), counts.end());
  std::stable_sort(often.begin(), often.end(),
                   [](auto &a, auto &b) { return a.second > b.second; });
  const auto n = static_cast<double>(magnitudes.size());
  std::int64_t no_multiples = static_cast<std::int64_t>(magnitudes.size());
  for (const auto &[value, count] : often) no_multiples -= count;
  for (auto step = std::llround(1.0 / unit); step > 1 && step * unit > 0.999 * least_width; --step)
    // The most frequent magnitude may be one of the few others, the next one hardly.
    for (std::size_t k = 0; k < std::min<std::size_t>(2, often.size()); ++k) {
      std::int64_t others = no_multiples, in = 0, values = 0;
      // The magnitudes in bins several times as wide, by the number of times and the bin's offset.
      std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> in_wider;
      for (const auto &[value, count] : often) {
        if (const std::int64_t from = value - often[k].first; from % step == 0) {
          in += count;
          ++values;
          for (const std::int64_t times : {2, 3, 5, 7})
            in_wider[{times, (from / step % times + times) % times}] += count;
        } else if (static_cast<double>(others += count) > (1.0 - most_in_bins) * n) {
          break;
        }
      }
      if (static_cast<double>(others) > (1.0 - most_in_bins) * n) continue;
      std::int64_t wider = 0;
      for (const auto &[bins, count] : in_wider) wider = std::max(wider, count);
      const std::int64_t offset = (often[k].first % step + step) % step;
      // Two values differ by many steps. Of three or more, hardly any other is common to all.
      const bool usual = (step == 2 || step == 5 || step == 10) && offset == 0;
      if (values < (usual ? 2 : 3) || (others > 0 && in - wider < 3 * others)) continue;
      return MagnitudeBins{nearest_decimal(static_cast<double>(step) * unit),
                           nearest_decimal(static_cast<double>(offset) * unit)};
    }
  return {};
}

}  // namespace

double size_of_magnitude(double magnitude) { return std::pow(10.0, 1.5 * magnitude); }

double magnitude_of_size(double size) { return std::log10(size) / 1.5; }

double as_typed(double magnitude) {
  const double typed = std::round(magnitude * 1e3) / 1e3 + 0.0;  // -0 becomes 0
  return std::fabs(magnitude - typed) < magnitude_tolerance ? typed : magnitude;
}

double MagnitudeBins::binned(double magnitude) const {
  if (!(width > 0.0)) return magnitude;
  return nearest_decimal(bin_of(magnitude - offset, width) * width + offset);
}

double MagnitudeBins::first_from(double limit) const {
  if (!(width > 0.0)) return limit;
  const double bin = std::ceil((limit - offset) / width - magnitude_tolerance);
  return nearest_decimal(bin * width + offset);
}

MagnitudeBins recognized_bins(const std::vector<double> &magnitudes) {
  const auto n = static_cast<double>(magnitudes.size());
  const auto share = [&](const MagnitudeBins &of) {
    const auto is_centre = [&](double m) { return of.has_centre(m); };
    return static_cast<double>(std::count_if(magnitudes.begin(), magnitudes.end(), is_centre)) / n;
  };
  MagnitudeBins bins;
  if (magnitudes.empty()) return bins;
  for (const double unit : {0.1, 0.01, 0.001, 1e-4}) {
    bins.share = share({unit});
    if (bins.share < most_in_bins) continue;
    if (unit >= least_width) bins.width = unit;
    if (const auto wide = widest_bins(magnitudes, unit)) {
      bins = *wide;
      bins.share = share(bins);
    }
    break;
  }
  for (const double wider : {0.1, 0.01, 0.001}) {
    const double times = wider / bins.width;
    if (bins.width > 0.0 && (times < 4.5 || !MagnitudeBins{bins.width}.has_centre(wider))) continue;
    const double by_chance = std::max(0.1, 1.0 / times), found = share({wider});
    if (found <= std::max(0.25, by_chance + 1.5 / std::sqrt(n))) continue;
    bins.wider = wider;
    bins.share_of_wider = found;
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

double maximum_curvature(const std::vector<double> &magnitudes, const MagnitudeBins &bins) {
  const std::vector<MagnitudeCount> counts = magnitude_counts(magnitudes, bins);
  const auto fullest = std::max_element(counts.begin(), counts.end(),
                                        [](auto &a, auto &b) { return a.count < b.count; });
  return fullest == counts.end() ? NAN : nearest_decimal(fullest->magnitude + 0.2);
}

std::vector<MagnitudeCount> magnitude_counts(const std::vector<double> &magnitudes,
                                             const MagnitudeBins &bins) {
  const double width = bins.width;
  std::map<std::int64_t, std::int64_t> counts;
  constexpr double most = 1e5;
  const auto [low, high] = std::minmax_element(magnitudes.begin(), magnitudes.end());
  if (!magnitudes.empty() &&
      (!((*high - *low) / width < most) || !(std::fabs(*high) / width < 1e15)))
    throw std::invalid_argument("magnitudes from " + text::number(*low) + " to " +
                                text::number(*high) + " in bins of " + text::number(width) +
                                ", expected fewer than 1e5 bins");
  for (const double m : magnitudes)
    ++counts[static_cast<std::int64_t>(bin_of(m - bins.offset, width))];
  std::vector<MagnitudeCount> out;
  if (counts.empty()) return out;
  auto rest = static_cast<std::int64_t>(magnitudes.size());
  for (std::int64_t bin = counts.begin()->first; bin <= counts.rbegin()->first; ++bin) {
    const auto found = counts.find(bin);
    const std::int64_t count = found == counts.end() ? 0 : found->second;
    out.push_back({nearest_decimal(static_cast<double>(bin) * width + bins.offset), count, rest});
    rest -= count;
  }
  return out;
}

}  // namespace LSM::postproc
