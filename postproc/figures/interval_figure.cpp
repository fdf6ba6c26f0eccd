// SPDX-License-Identifier: GPL-2.0-or-later
#include "interval_figure.h"

#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

std::string source_of(const IntervalCurve &curve) {
  return curve.earthquakes ? curve.from() : "sizes >= " + text(curve.threshold);
}

namespace {

/// The table of the densities without its rows.
Table density_table(const std::vector<IntervalCurve> &curves, bool rescaled) {
  Table table("curve,model,threshold,bin_lo,bin_hi,theta,count,density,error,label");
  table.comment(
      rescaled
          ? "inter-event times from start to start, divided by their mean"
          : "inter-event times from start to start in model time (earthquakes: days), densities "
            "in 1 / model time; errors: Poisson");
  std::set<std::string> sources;
  for (const IntervalCurve &curve : curves) sources.insert(source_of(curve));
  for (const std::string &source : sources) table.comment(source);
  return table;
}

bool is_rejected(const IntervalCurve &curve, const GeneralisedGammaFit *fit) {
  for (const IntervalFit &candidate : curve.fits)
    if (&candidate.fit == fit) return candidate.p.value < 0.05;
  return false;
}

/// The fitted density of a curve, thin and dotted if it is rejected.
void add_fit(Curves &plot, std::int64_t number, const IntervalCurve &curve,
             const GeneralisedGammaFit &fit, bool rejected) {
  plot.add_law(curve.bins.front().lo, curve.bins.back().hi,
               fmt::format("{}*$1**({})*exp(-$1**({})/{})", text_io::number(fit.C),
                           text_io::number(fit.gamma - 1.0), text_io::number(fit.delta),
                           text_io::number(fit.B)),
               fmt::format("lt {}{}", number, rejected ? " dt 3 lw 0.7" : ""));
}

}  // namespace

Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled, int width) {
  Table table = density_table(curves, rescaled);
  std::set<double> thresholds;
  for (const IntervalCurve &curve : curves) thresholds.insert(curve.threshold.size);
  Curves plot("$6", "$7 > 0");
  Extent range, heights;
  std::int64_t number = 0;
  bool any_accepted = false, any_rejected = false;
  for (const IntervalCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const LogBin &bin : curve.bins) {
      table.add(number).add(curve.model).add(curve.threshold.size);
      add_bin(table, bin);
      table.row(curve.label);
      if (bin.count == 0) continue;
      heights.add(bin.density);
      range.add(bin.lo);
      range.add(bin.hi);
    }
    plot.add_data(number, 8, 9);
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{}{} ({} times)", curve.label,
                         thresholds.size() > 1 ? ", " + curve.from() : "", curve.n));
    const GeneralisedGammaFit *const fit = curve.drawn();
    if (!fit) continue;
    const bool rejected = is_rejected(curve, fit);
    (rejected ? any_rejected : any_accepted) = true;
    add_fit(plot, number, curve, *fit, rejected);
  }
  if (number == 0)
    throw std::runtime_error("no catalogue has two events above the threshold, nothing to draw");
  if (rescaled)
    plot.add_law(range.lo, range.hi, "0.5*$1**(-0.33)*exp(-$1/1.58)", "lt 8 dt (6,4) lw 2",
                 "earthquakes, Corral (2004)");
  if (any_accepted)
    plot.add(Curves::legend, "keyentry with lines lt 8", "lines: fitted generalised gamma");
  if (any_rejected)
    plot.add(Curves::legend, "keyentry with lines lt 8 dt 3 lw 0.7", "fit rejected (p < 0.05)");
  return plot.figure(
      std::move(table),
      axis("x",
           rescaled ? "inter-event time θ (mean = 1)" : "inter-event time θ (model time units)",
           true, range.lo, range.hi) +
          axis("y",
               rescaled ? "probability density f(θ)" : "probability density f(θ) (1 / model time)",
               true, 0.3 * heights.lo, heights.hi),
      width);
}

}  // namespace LSM::postproc
