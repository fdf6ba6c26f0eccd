// SPDX-License-Identifier: GPL-2.0-or-later
#include "nature.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "clustering.h"
#include "generalised_gamma.h"
#include "intervals.h"
#include "magnitudes.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

/// One catalogue above one smallest size.
struct Sample {
  std::vector<double> times, magnitudes;
  std::vector<std::pair<Measured NatureRow::*, Measured>> numbers;  // the same of all samples
  std::string why;                                                  // delta cannot be fitted
};

Sample sample_of(const EventTable &table, double threshold, const Sample *reference,
                 const NatureSettings &settings) {
  Sample out;
  const auto add = [&out](Measured NatureRow::*number, double value, double error = NAN) {
    out.numbers.push_back({number, {value, error}});
  };
  const std::vector<double> sizes = column_from(table, threshold, &Event::size);
  const MagnitudeScale scale;
  for (const double size : sizes) out.magnitudes.push_back(scale.of(size) - scale.of(threshold));
  out.times = over_mean(inter_event_times(table, threshold));
  const Clustering c = clustering(out.times, 1, settings.seed);
  add(&NatureRow::variation, c.variation.value);
  add(&NatureRow::burstiness, c.finite_burstiness.value);
  add(&NatureRow::memory, c.memory.value);
  add(&NatureRow::after_short, c.after[0].value);
  const BValue b = b_value(out.magnitudes, 0.0);
  add(&NatureRow::b, b.b, b.error);
  const std::vector<double> positive = positive_ones(out.times);
  const GeneralisedGammaFit fit = fit_with_share(positive, settings.shortest, 1.0);
  add(&NatureRow::gamma, fit.gamma, fit.se_gamma);
  add(&NatureRow::B, fit.B, fit.se_B);
  add(&NatureRow::C, fit.C, fit.se_C);
  const GeneralisedGammaFit free = fit_with_share(positive, settings.shortest, NAN);
  add(&NatureRow::free_gamma, free.gamma, free.se_gamma);
  add(&NatureRow::free_delta, free.delta, free.se_delta);
  add(&NatureRow::free_B, free.B, free.se_B);
  add(&NatureRow::free_C, free.C, free.se_C);
  if (free.degenerate) out.why = free.why;
  const AroundLarge around =
      around_large(column_from(table, threshold, &Event::t_start), sizes, settings.share);
  add(&NatureRow::before, around.before);
  add(&NatureRow::after, around.after);
  const auto compare = [&](Measured NatureRow::*number, std::vector<double> Sample::*values) {
    const RescaledDistance apart =
        rescaled_distance(reference->*values, out.*values, settings.replicas, settings.seed);
    add(number, apart.distance, apart.error);
  };
  if (!reference) return out;
  compare(&NatureRow::distance, &Sample::times);
  compare(&NatureRow::size_distance, &Sample::magnitudes);
  return out;
}

/// Mean and its error: from the scatter of two and more, and not below that of their own errors.
Measured mean_of(std::vector<Measured> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](const Measured &one) { return std::isnan(one.value); }),
               values.end());
  if (values.empty()) return {};
  if (values.size() == 1) return values.front();
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0, own = 0.0;
  for (const Measured &one : values) sum += one.value;
  for (const Measured &one : values) {
    squares += (one.value - sum / n) * (one.value - sum / n);
    if (one.error > 0.0) own += one.error * one.error;
  }
  return {sum / n, std::sqrt(std::max(squares / (n - 1.0) / n, own / n / n))};
}

NatureRow row_of(const std::vector<Sample> &samples) {
  NatureRow row;
  row.catalogues = static_cast<std::int64_t>(samples.size());
  std::vector<std::vector<Measured>> numbers(samples.front().numbers.size());
  for (const Sample &sample : samples) {
    row.n += static_cast<std::int64_t>(sample.magnitudes.size());
    row.times.insert(row.times.end(), sample.times.begin(), sample.times.end());
    row.magnitudes.insert(row.magnitudes.end(), sample.magnitudes.begin(), sample.magnitudes.end());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].push_back(sample.numbers[i].second);
    if (!sample.why.empty()) {
      ++row.without_delta;
      row.why = sample.why;
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    row.*(samples.front().numbers[i].first) = mean_of(numbers[i]);
  return row;
}

}  // namespace

std::vector<NatureRow> nature_rows(const std::vector<EventTable> &tables,
                                   const NatureSettings &settings) {
  std::vector<std::vector<const EventTable *>> groups;
  for (const EventTable &table : tables) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&table](const auto &group) {
      return group.front()->label == table.label;
    });
    if (same == groups.end())
      groups.push_back({&table});
    else
      same->push_back(&table);
  }
  Sample reference;
  std::vector<NatureRow> rows;
  for (const auto &group : groups) {
    const EventTable &first = *group.front();
    std::vector<double> given = first.earthquakes() ? settings.reference : settings.thresholds;
    std::sort(given.begin(), given.end());
    std::vector<Threshold> thresholds(given.begin(), given.end());
    if (thresholds.empty()) thresholds.emplace_back();
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
      const double least = thresholds[i].complete_in(first).size;
      // If the catalogue begins above a smallest size, the next one gives the same.
      if (i + 1 < thresholds.size() &&
          events_from(first, least) ==
              events_from(first, thresholds[i + 1].complete_in(first).size))
        continue;
      std::vector<Sample> samples;
      for (const EventTable *table : group)
        if (events_from(*table, least) >= settings.fewest)
          samples.push_back(
              sample_of(*table, least, reference.times.empty() ? nullptr : &reference, settings));
      if (samples.empty() && rows.empty())
        throw std::runtime_error(
            fmt::format("{}: fewer than {} events to compare with", first.path, settings.fewest));
      if (samples.empty()) continue;
      if (rows.empty()) reference = samples.front();
      NatureRow row = row_of(samples);
      row.label = first.label;
      row.earthquakes = first.earthquakes();
      row.threshold = least;
      IntervalCurve words;
      words.earthquakes = row.earthquakes;
      words.threshold.size = least;
      row.from = words.from();
      rows.push_back(std::move(row));
    }
  }
  std::stable_sort(rows.begin() + 1, rows.end(), [](const NatureRow &a, const NatureRow &b) {
    return a.distance.value < b.distance.value;
  });
  return rows;
}

std::vector<LogBin> time_densities(const NatureRow &row) {
  std::vector<LogBin> some;
  for (const LogBin &bin : LogHistogram(row.times, std::pow(10.0, 0.2)).bins())
    if (bin.count > 2) some.push_back(bin);
  return some;
}

std::vector<double> shares_above(const NatureRow &row) {
  std::vector<double> sorted = row.magnitudes, shares;
  std::sort(sorted.begin(), sorted.end());
  for (double m = 0.0; m <= sorted.back(); m += 0.1) {
    const auto above = std::lower_bound(sorted.begin(), sorted.end(), m - 1e-9);
    shares.push_back(static_cast<double>(sorted.end() - above) /
                     static_cast<double>(sorted.size()));
  }
  return shares;
}

}  // namespace LSM::postproc
