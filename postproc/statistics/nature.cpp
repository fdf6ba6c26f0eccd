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

/// Numbers that are averaged over the catalogues of a row.
constexpr Measured NatureRow::*averaged[] = {&NatureRow::b,          &NatureRow::variation,
                                             &NatureRow::burstiness, &NatureRow::memory,
                                             &NatureRow::before,     &NatureRow::after_short,
                                             &NatureRow::after,      &NatureRow::gamma,
                                             &NatureRow::B,          &NatureRow::C,
                                             &NatureRow::distance,   &NatureRow::free_gamma,
                                             &NatureRow::free_delta, &NatureRow::free_B,
                                             &NatureRow::free_C,     &NatureRow::size_distance};

/// One catalogue above one smallest size. `why` is set if a free delta cannot be determined.
NatureRow sample_of(const EventTable &table, double threshold, const NatureRow *reference,
                    const NatureSettings &settings) {
  NatureRow out;
  const std::vector<double> sizes = column_from(table, threshold, &Event::size);
  const MagnitudeScale scale;
  for (const double size : sizes) out.magnitudes.push_back(scale.of(size) - scale.of(threshold));
  try {
    out.times = over_mean(inter_event_times(table, threshold));
  } catch (const std::invalid_argument &) {
    throw std::runtime_error(table.path + ": all events start at the same time");
  }
  const Clustering c = clustering(out.times, 1, settings.seed);
  out.variation.value = c.variation.value;
  out.burstiness.value = c.finite_burstiness.value;
  out.memory.value = c.memory.value;
  out.after_short.value = c.after[0].value;
  const BValue b = b_value(out.magnitudes, 0.0);
  out.b = {b.b, b.error};
  const std::vector<double> positive = positive_ones(out.times);
  const double mean = mean_of(inter_event_times(table, threshold));
  const double shortest = std::isnan(settings.shortest)
                              ? shortest_time(table.picker_memory() / mean, 1.0)
                              : settings.shortest;
  const GeneralisedGammaFit fit = fit_with_share(positive, shortest, 1.0);
  out.gamma = {fit.gamma, fit.se_gamma};
  out.B = {fit.B, fit.se_B};
  out.C = {fit.C, fit.se_C};
  const GeneralisedGammaFit free = fit_with_share(positive, shortest, NAN);
  out.free_gamma = {free.gamma, free.se_gamma};
  out.free_delta = {free.delta, free.se_delta};
  out.free_B = {free.B, free.se_B};
  out.free_C = {free.C, free.se_C};
  if (free.degenerate) out.why = free.why;
  const AroundLarge around =
      around_large(column_from(table, threshold, &Event::t_start), sizes, settings.share);
  out.before.value = around.before;
  out.after.value = around.after;
  if (!reference) return out;
  const int replicas = settings.replicas;
  out.distance = rescaled_distance(reference->times, out.times, replicas, settings.seed);
  out.size_distance =
      rescaled_distance(reference->magnitudes, out.magnitudes, replicas, settings.seed);
  return out;
}

/// Mean and standard error: of several values from their scatter, but not below what their own
/// errors imply.
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

NatureRow row_of(const std::vector<NatureRow> &samples) {
  NatureRow row;
  row.catalogues = static_cast<std::int64_t>(samples.size());
  for (const NatureRow &sample : samples) {
    row.n += static_cast<std::int64_t>(sample.magnitudes.size());
    row.times.insert(row.times.end(), sample.times.begin(), sample.times.end());
    row.magnitudes.insert(row.magnitudes.end(), sample.magnitudes.begin(), sample.magnitudes.end());
    if (sample.why.empty()) continue;
    ++row.without_delta;
    row.why = sample.why;
  }
  for (const auto number : averaged) {
    std::vector<Measured> values;
    for (const NatureRow &sample : samples) values.push_back(sample.*number);
    row.*number = mean_of(values);
  }
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
  NatureRow reference;
  std::vector<NatureRow> rows;
  for (const auto &group : groups) {
    const EventTable &first = *group.front();
    std::vector<double> given = first.earthquakes() ? settings.reference : settings.thresholds;
    std::sort(given.begin(), given.end());
    std::vector<Threshold> thresholds(given.begin(), given.end());
    if (thresholds.empty()) thresholds.emplace_back();
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
      const double least = thresholds[i].complete_in(first).size;
      if (!(least > 0.0))
        throw std::invalid_argument("--threshold 0 has no magnitude, expected a larger size");
      // Where the catalogue begins above this smallest size, the next one selects the same events.
      if (i + 1 < thresholds.size() &&
          events_from(first, least) ==
              events_from(first, thresholds[i + 1].complete_in(first).size))
        continue;
      std::vector<NatureRow> samples;
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
      row.from = events_from_text(row.earthquakes, least);
      rows.push_back(std::move(row));
    }
  }
  std::stable_sort(rows.begin() + 1, rows.end(), [](const NatureRow &a, const NatureRow &b) {
    // Rows without a distance come last.
    return a.distance.value < b.distance.value ||
           (std::isnan(b.distance.value) && !std::isnan(a.distance.value));
  });
  return rows;
}

std::vector<LogBin> time_densities(const NatureRow &row) {
  std::vector<LogBin> some;
  for (const LogBin &bin : log_histogram(row.times, std::pow(10.0, 0.2)))
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
