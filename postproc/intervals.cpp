// SPDX-License-Identifier: GPL-2.0-or-later
#include "intervals.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "lsm_sum.h"
#include "lsm_text_io.h"

namespace LSM::postproc {

const GeneralisedGammaFit *IntervalCurve::drawn() const {
  for (const IntervalFit &candidate : fits)
    if (!candidate.fit.degenerate) return &candidate.fit;
  return nullptr;
}

std::vector<double> inter_event_times(const EventTable &events, double threshold) {
  std::vector<double> times;
  double before = std::nan("");
  for (std::size_t i = 0; i < events.size.size(); ++i) {
    if (!(events.size[i] >= threshold)) continue;
    if (!std::isnan(before)) times.push_back(events.t_start[i] - before);
    before = events.t_start[i];
  }
  return times;
}

std::vector<IntervalCurve> interval_curves(const std::vector<EventTable> &tables,
                                           const IntervalSettings &settings) {
  if (!(settings.shortest >= 0.0) || !std::isfinite(settings.shortest))
    throw std::invalid_argument("--shortest: expected a time of zero or more");
  if (settings.replicas < 0) throw std::invalid_argument("--replicas: expected 0 or more");
  std::vector<IntervalCurve> curves;
  for (const EventTable &table : tables) {
    for (const double threshold : settings.thresholds) {
      IntervalCurve curve;
      curve.label = table.label;
      curve.model = table.info.model;
      curve.threshold = std::max(threshold, table.complete_from);
      std::vector<double> times = inter_event_times(table, curve.threshold);
      curve.n = static_cast<std::int64_t>(times.size());
      curve.mean = sum_pairwise(times.data(), times.size()) / static_cast<double>(times.size());
      // Events of zero length can start at the same time.
      times.erase(std::remove_if(times.begin(), times.end(), [](double t) { return !(t > 0.0); }),
                  times.end());
      LogHistogram histogram(settings.factor);
      for (double &time : times) {
        if (settings.rescale) time /= curve.mean;
        histogram.add(time);
      }
      curve.bins = histogram.bins();
      // Fitted bins keep the normalisation of the whole density, as C belongs to it.
      std::vector<LogBin> fitted;
      for (const LogBin &bin : curve.bins)
        if (bin.lo >= settings.shortest) fitted.push_back(bin);
      for (const double delta : settings.deltas) {
        GeneralisedGammaOptions options;
        options.fix_delta = delta;
        if (settings.least_squares)
          curve.fits.push_back({"least squares", delta, fit_least_squares(fitted, options)});
        if (settings.maximum_likelihood)
          curve.fits.push_back({"maximum likelihood", delta,
                                fit_maximum_likelihood(times, settings.shortest, options)});
      }
      for (IntervalFit &fit : curve.fits) {
        if (fit.fit.degenerate) continue;
        fit.p = p_value(fit.fit, settings.replicas, settings.seed);
        if (fit.fit.dof == 0) fit.p_error = std::sqrt(fit.p * (1.0 - fit.p) / settings.replicas);
      }
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

Figure interval_figure(const std::vector<IntervalCurve> &curves, const IntervalSettings &settings) {
  Figure figure{Table({"curve", "model", "threshold", "bin_lo", "bin_hi", "theta", "count",
                       "density", "error", "label"}),
                {},
                {}};
  figure.table.comment(
      settings.rescale ? "inter-event times from start to start, divided by their mean"
                       : "inter-event times from start to start in model time, densities in 1 / "
                         "model time; errors: Poisson");
  std::string points, lines;
  std::vector<std::string> titles;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0, first = lowest,
         last = 0.0;
  std::set<double> thresholds;
  for (const IntervalCurve &curve : curves) thresholds.insert(curve.threshold);
  std::int64_t number = 0;
  for (const IntervalCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const LogBin &bin : curve.bins) {
      figure.table.add(number).add(curve.model).add(curve.threshold);
      add_bin(figure.table, bin);
      figure.table.add(curve.label).end_row();
      if (bin.count == 0) continue;
      lowest = std::min(lowest, bin.density);
      highest = std::max(highest, bin.density);
      first = std::min(first, bin.lo);
      last = std::max(last, bin.hi);
    }
    std::string title = curve.label;
    if (thresholds.size() > 1) title += fmt::format(", s ≥ {}", short_number(curve.threshold));
    const std::string row = fmt::format("row({})", number);
    points += fmt::format(
        "{0}{1}, \\\n     table using ({2}):8 with points lt {3} notitle, \\\n"
        "     keyentry with linespoints lt {3} title {4}",
        points.empty() ? "plot " : ", \\\n     ", error_bars(row, "$8", "$9", number), row, number,
        quote(fmt::format("{} ({} times)", title, curve.n)));
    titles.push_back(title + " (00000 times)");
    const GeneralisedGammaFit *const fit = curve.drawn();
    if (fit)
      lines += fmt::format(
          ", \\\n     [{}:{}] '+' using 1:({}*$1**({})*exp(-$1**({})/{})) with lines lt {} "
          "notitle",
          text_io::number(curve.bins.front().lo), text_io::number(curve.bins.back().hi),
          text_io::number(fit->C), text_io::number(fit->gamma - 1.0), text_io::number(fit->delta),
          text_io::number(fit->B), number);
  }
  if (!lines.empty())
    lines += ", \\\n     keyentry with lines lt 8 title 'lines: fitted generalised gamma'";
  titles.emplace_back();
  figure.size = size_with_key(titles, settings.width);
  if (number == 0)
    throw std::runtime_error("no catalogue has two events above the threshold, nothing to draw");
  figure.script = axis("x",
                       settings.rescale ? "inter-event time θ (mean = 1)"
                                        : "inter-event time θ (model time units)",
                       true, first, last) +
                  axis("y",
                       settings.rescale ? "probability density f(θ)"
                                        : "probability density f(θ) (1 / model time)",
                       true, 0.3 * lowest, highest) +
                  "row(k) = $1 == k && $7 > 0 ? $6 : NaN\n" + std::string(error_bar_function) +
                  "set samples 400\n" + points + lines + "\n";
  return figure;
}

}  // namespace LSM::postproc
