// SPDX-License-Identifier: GPL-2.0-or-later
#include "intervals.h"

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

int shuffles_for(std::size_t times) {
  return static_cast<int>(
      std::clamp<std::size_t>(20'000'000 / std::max<std::size_t>(times, 1), 19, 200));
}

namespace {

std::vector<IntervalFit> fits_of(const std::vector<double> &times, const IntervalCurve &curve,
                                 const IntervalSettings &settings) {
  // C belongs to the density of all times: bins are selected without renormalising them, and above
  // the shortest time the fitted density integrates to the share of the times there.
  std::vector<LogBin> bins;
  for (const LogBin &bin : curve.bins)
    if (!settings.shortest || bin.lo >= curve.shortest) bins.push_back(bin);
  std::vector<IntervalFit> fits;
  for (const double delta : settings.deltas) {
    if (settings.maximum_likelihood) {
      GeneralisedGammaFit fit = fit_maximum_likelihood(times, curve.shortest, delta);
      const double share = static_cast<double>(fit.n) / static_cast<double>(times.size());
      fit.C *= share;
      fit.se_C *= share;
      fits.push_back({"maximum likelihood", delta, fit});
    }
    if (settings.least_squares)
      fits.push_back({"least squares", delta, fit_least_squares(bins, delta)});
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
  curve.threshold = threshold.of(table);
  std::vector<double> times = inter_event_times(table, curve.threshold.size);
  curve.n = static_cast<std::int64_t>(times.size());
  curve.mean = mean_of(times);
  curve.variation = variation_of(times);
  const int shuffles = settings.shuffles < 0 ? shuffles_for(times.size()) : settings.shuffles;
  if (shuffles > 0) {
    curve.clustering = clustering(times, shuffles, settings.seed);
    curve.steadiness = steadiness(column_from(table, curve.threshold.size, &Event::t_start),
                                  shuffles, settings.seed);
  }
  // Times of 0 occur, as events of zero length can start at the same time.
  times.erase(std::remove_if(times.begin(), times.end(), [](double t) { return !(t > 0.0); }),
              times.end());
  curve.zeros = curve.n - static_cast<std::int64_t>(times.size());
  if (settings.rescale)
    for (double &time : times) time /= curve.mean;
  curve.bins = log_histogram(times);
  curve.memory = table.picker_memory();
  if (settings.rescale) curve.memory /= curve.mean;
  if (!times.empty())
    curve.shortest = shortest_time(settings.shortest, curve.memory, curve.fitted_mean());
  curve.fits = fits_of(times, curve, settings);
  return curve;
}

}  // namespace

std::vector<IntervalCurve> interval_curves(const std::vector<EventTable> &tables,
                                           const IntervalSettings &settings) {
  if (settings.shortest && !(*settings.shortest >= 0.0 && std::isfinite(*settings.shortest)))
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
