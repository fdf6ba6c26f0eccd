// SPDX-License-Identifier: GPL-2.0-or-later
#include "intervals.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "samples.h"

namespace LSM::postproc {

const IntervalFit *IntervalCurve::drawn() const {
  for (const IntervalFit &candidate : fits)
    if (!candidate.fit.degenerate) return &candidate;
  return nullptr;
}

std::string events_from_text(bool earthquakes, double least) {
  return earthquakes ? fmt::format("magnitudes >= {:.3g}", std::log10(least) / 1.5)
                     : fmt::format("sizes >= {:.4g}", least);
}

std::vector<double> inter_event_times(const EventTable &events, double threshold) {
  return differences(column_from(events, threshold, &Event::t_start));
}

namespace {

/// Ranks from 1 on; equal values share their mean rank.
std::vector<double> ranks_of(const std::vector<double> &values) {
  std::vector<std::pair<double, std::size_t>> sorted;
  sorted.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sorted.emplace_back(values[i], i);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < sorted.size();) {
    std::size_t end = first;
    while (end < sorted.size() && sorted[end].first == sorted[first].first) ++end;
    for (std::size_t i = first; i < end; ++i)
      ranks[sorted[i].second] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return ranks;
}

}  // namespace

RankCorrelation successive_rank_correlation(const std::vector<double> &times) {
  RankCorrelation found;
  if (times.size() < 5) return found;
  const std::size_t n = times.size() - 1;
  // All times are sorted once; the ranks without the last and without the first time follow.
  std::vector<double> one = ranks_of(times), next(one.begin() + 1, one.end());
  const auto leave_out = [](std::vector<double> &ranks, double left_out) {
    for (double &rank : ranks) rank -= rank > left_out ? 1.0 : rank == left_out ? 0.5 : 0.0;
  };
  const double first = one.front(), last = one.back();
  one.pop_back();
  leave_out(one, last);
  leave_out(next, first);
  found.rho = gsl_stats_correlation(one.data(), 1, next.data(), 1, n);
  const double freedom = static_cast<double>(n) - 2.0;
  const double t = std::fabs(found.rho) * std::sqrt(freedom / (1.0 - found.rho * found.rho));
  if (!std::isnan(found.rho)) found.p = std::isinf(t) ? 0.0 : 2.0 * gsl_cdf_tdist_Q(t, freedom);
  return found;
}

std::vector<double> times_at_places(const EventTable &table, double threshold, int places) {
  const double length = table.length();
  if (!table.info.x_begin || !table.info.rupture_length || !(length > 0.0))
    throw std::invalid_argument(
        table.path +
        ": times at places: no columns x_begin and rupture_length, or no "
        "length in the header, expected a catalogue of ruptures of a fault");
  std::vector<double> times;
  for (int place = 0; place < places; ++place) {
    const double x = (place + 0.5) * length / places;
    double before = NAN;
    for (const Event &event : table.details) {
      if (!(event.size >= threshold)) continue;
      // The ruptured stretch may continue across the periodic boundary.
      double beyond = std::fmod(x - event.x_begin, length);
      if (beyond < 0.0) beyond += length;
      if (beyond >= event.rupture_length) continue;
      if (!std::isnan(before)) times.push_back(event.t_start - before);
      before = event.t_start;
    }
  }
  return times;
}

GeneralisedGammaFit fit_with_share(const std::vector<double> &times, double shortest,
                                   double delta) {
  GeneralisedGammaFit fit = fit_maximum_likelihood(times, shortest, delta);
  const double share = static_cast<double>(fit.n) / static_cast<double>(times.size());
  fit.C *= share;
  fit.se_C *= share;
  return fit;
}

int shuffles_for(std::size_t times) {
  return static_cast<int>(
      std::clamp<std::size_t>(20'000'000 / std::max<std::size_t>(times, 1), 19, 200));
}

std::vector<LogBin> bins_from(std::vector<LogBin> bins, double shortest) {
  bins.erase(std::remove_if(bins.begin(), bins.end(),
                            [shortest](const LogBin &bin) { return bin.lo < shortest; }),
             bins.end());
  return bins;
}

std::vector<GammaOfCut> gamma_of_cuts(const std::vector<double> &times, double memory,
                                      double mean) {
  if (times.empty()) return {};
  std::vector<double> cuts = {0.0, 0.05 * mean, 0.1 * mean, 0.2 * mean};
  if (!std::isnan(memory))
    for (const double memories : {0.5, 1.0, 2.5, 5.0, 10.0}) cuts.push_back(memories * memory);
  std::sort(cuts.begin(), cuts.end());
  std::vector<GammaOfCut> found;
  for (const double cut : cuts) found.push_back({cut, fit_maximum_likelihood(times, cut, 1.0)});
  return found;
}

namespace {

void add_clustering(IntervalCurve &curve, const EventTable &table, const std::vector<double> &times,
                    int shuffles, const IntervalSettings &settings) {
  curve.clustering = clustering(times, shuffles, settings.seed);
  curve.starts = column_from(table, curve.threshold.size, &Event::t_start);
  curve.steadiness =
      steadiness(curve.starts, settings.steady, settings.steady_events, shuffles, settings.seed);
  auto after = times_after_thirds(times);
  for (std::size_t k = 0; k < after.size(); ++k) {
    for (double &time : after[k]) time /= curve.mean;
    curve.after[k] = log_histogram(after[k], std::pow(10.0, 0.2));
  }
}

/// \param shortest shortest time that maximum likelihood uses
std::vector<IntervalFit> fits_of(const std::vector<double> &times, const std::vector<LogBin> &bins,
                                 double shortest, const IntervalSettings &settings) {
  // C belongs to the density of all times, so the bins are selected without renormalising them.
  const std::vector<LogBin> fitted =
      std::isnan(settings.shortest) ? bins : bins_from(bins, shortest);
  std::vector<IntervalFit> fits;
  for (const double delta : settings.deltas) {
    if (settings.maximum_likelihood)
      fits.push_back({"maximum likelihood", delta, fit_with_share(times, shortest, delta)});
    if (settings.least_squares)
      fits.push_back({"least squares", delta, fit_least_squares(fitted, delta)});
  }
  for (IntervalFit &fit : fits) {
    if (fit.fit.degenerate) continue;
    fit.p.value = p_value(fit.fit, times, settings.replicas, settings.seed);
    if (fit.fit.dof == 0) fit.p = share_of(fit.p.value, settings.replicas);
  }
  return fits;
}

IntervalCurve curve_of(const EventTable &table, const Threshold &threshold,
                       const IntervalSettings &settings) {
  IntervalCurve curve;
  curve.label = table.label;
  curve.model = table.info.model;
  curve.earthquakes = table.earthquakes();
  curve.unit = table.time_unit();
  curve.rescaled = settings.rescale;
  curve.threshold = threshold.complete_in(table);
  std::vector<double> times = settings.places > 0
                                  ? times_at_places(table, curve.threshold.size, settings.places)
                                  : inter_event_times(table, curve.threshold.size);
  curve.n = static_cast<std::int64_t>(times.size());
  curve.mean = mean_of(times);
  curve.variation = variation_of(times);
  const int shuffles = settings.shuffles < 0 ? shuffles_for(times.size()) : settings.shuffles;
  if (shuffles > 0 && settings.places == 0) add_clustering(curve, table, times, shuffles, settings);
  times = positive_ones(std::move(times));
  if (settings.rescale)
    for (double &time : times) time /= curve.mean;
  curve.bins = log_histogram(times, settings.factor);
  curve.memory = settings.places > 0 ? NAN : table.picker_memory();
  const double mean = settings.rescale ? 1.0 : curve.mean;
  if (settings.rescale) curve.memory /= curve.mean;
  if (!times.empty())
    curve.shortest = std::isnan(settings.shortest) ? shortest_time(curve.memory, mean)
                                                   : settings.shortest * mean;
  curve.fits = fits_of(times, curve.bins, curve.shortest, settings);
  if (settings.cuts) curve.cuts = gamma_of_cuts(times, curve.memory, mean);
  return curve;
}

}  // namespace

std::vector<IntervalCurve> interval_curves(const std::vector<EventTable> &tables,
                                           const IntervalSettings &settings) {
  if (!std::isnan(settings.shortest) &&
      !(settings.shortest >= 0.0 && std::isfinite(settings.shortest)))
    throw std::invalid_argument("shortest time: expected a multiple of the mean of zero or more");
  std::vector<Threshold> thresholds(settings.thresholds.begin(), settings.thresholds.end());
  if (thresholds.empty()) thresholds.emplace_back();
  std::vector<IntervalCurve> curves;
  for (const EventTable &table : tables)
    for (const Threshold &threshold : thresholds)
      curves.push_back(curve_of(table, threshold, settings));
  return curves;
}

}  // namespace LSM::postproc
