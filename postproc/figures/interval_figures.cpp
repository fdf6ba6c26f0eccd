// SPDX-License-Identifier: GPL-2.0-or-later
#include "interval_figures.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

std::string source_of(const IntervalCurve &curve) {
  return curve.earthquakes ? curve.from() : "sizes >= " + text(curve.threshold);
}

namespace {

/// Adds the fitted density over the times that were fitted, dotted if the fit is rejected.
void add_fit(Curves &plot, std::int64_t number, const IntervalCurve &curve,
             const GeneralisedGammaFit &fit, bool rejected) {
  plot.add_law(
      std::max(curve.bins.front().lo, fit.lo), curve.bins.back().hi,
      fmt::format("{}*$1**({})*exp(-$1**({})/{})", text::number(fit.C),
                  text::number(fit.gamma - 1.0), text::number(fit.delta), text::number(fit.B)),
      fmt::format("lt {}{}", number, rejected ? " dt 3 lw 2" : " dt 1 lw 1.6"));
}

}  // namespace

Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled) {
  Table table("curve,model,threshold,bin_lo,bin_hi,theta,count,density,error,label");
  table.comment(
      rescaled
          ? "inter-event times from start to start, divided by their mean"
          : "inter-event times from start to start in model time (earthquakes: days), densities "
            "in 1 / model time; errors: Poisson");
  std::set<double> thresholds;
  std::set<std::string> sources;
  for (const IntervalCurve &curve : curves) {
    thresholds.insert(curve.threshold.size);
    sources.insert(source_of(curve));
  }
  for (const std::string &source : sources) table.comment(source);
  Curves plot("$6", "$7 > 0");
  Range range, heights;
  std::int64_t number = 0;
  bool any_accepted = false, any_rejected = false;
  for (const IntervalCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const LogBin &bin : curve.bins) {
      table.row(number, curve.model, curve.threshold.size, bin, curve.label);
      if (bin.count == 0) continue;
      heights.add(bin.density);
      range.add(bin.lo);
      range.add(bin.hi);
    }
    plot.add_data(number, 8, 9);
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{}{} ({} times)", curve.label,
                         thresholds.size() > 1 ? ", " + curve.from() : "", curve.n));
    const IntervalFit *const fit = curve.drawn();
    if (!fit) continue;
    const bool rejected = fit->rejected();
    (rejected ? any_rejected : any_accepted) = true;
    add_fit(plot, number, curve, fit->fit, rejected);
  }
  if (number == 0)
    throw DegenerateData(
        std::any_of(curves.begin(), curves.end(), [](auto &curve) { return curve.n > 0; })
            ? "all times are 0: the events above the threshold start together, nothing to draw"
            : "no catalogue has two events above the threshold, nothing to draw");
  if (rescaled)
    plot.add_law(range.lo, range.hi, "0.5*$1**(-0.33)*exp(-$1/1.58)", "lt 8 dt (6,4) lw 2",
                 "earthquakes, Corral (2004)");
  if (any_accepted)
    plot.add(Curves::legend, "keyentry with lines lt 8 dt 1 lw 1.6", "fit not rejected");
  if (any_rejected)
    plot.add(Curves::legend, "keyentry with lines lt 8 dt 3 lw 2", "fit rejected (p < 0.05)");
  const bool days =
      std::all_of(curves.begin(), curves.end(), [](auto &curve) { return curve.earthquakes; });
  const std::string unit = days ? "days" : "model time";
  return plot.figure(
      std::move(table),
      axis("x", rescaled ? "inter-event time θ (mean = 1)" : "inter-event time θ (" + unit + ")",
           true, range.lo, range.hi) +
          axis("y", "probability density f(θ)" + (rescaled ? std::string() : " (1 / " + unit + ")"),
               true, 0.3 * heights.lo, heights.hi));
}

namespace {

/// A number of Clustering: its column, its description, and the random series it is compared with.
struct Named {
  const char *column, *text, *random;
  AgainstChance Clustering::*number;
};

constexpr Named numbers[] = {
    {"variation", "variation (standard deviation / mean)", "independent", &Clustering::variation},
    {"finite_burstiness", "burstiness", "independent", &Clustering::finite_burstiness},
    {"memory", "memory coefficient", "shuffled", &Clustering::memory}};

}  // namespace

Table clustering_table(const std::vector<IntervalCurve> &curves) {
  TableOf<IntervalCurve> table;
  table.column("label", "catalogue", [](auto &curve) { return curve.label; });
  table.show("events", [](auto &curve) { return curve.from(); });
  table.data("threshold", [](auto &curve) { return curve.threshold.size; });
  table.column("n", "times", &IntervalCurve::n);
  table.column(
      "departure", "departure from a steady rate",
      [](auto &curve) { return curve.steadiness.departure; }, 2);
  table.column(
      "steady_p", "p of a steady rate", [](auto &curve) { return curve.steadiness.p; }, 2);
  for (const Named &one : numbers) {
    const std::string name = one.column;
    const auto of = [number = one.number](const IntervalCurve &c) { return c.clustering.*number; };
    table.column(
        name, one.text, [of](auto &curve) { return of(curve).value; }, 3);
    table.show(one.random, [of](auto &c) { return Measured{of(c).mean, of(c).deviation}; });
    table.data(name + "_random", [of](auto &curve) { return of(curve).mean; });
    table.data(name + "_random_deviation", [of](auto &curve) { return of(curve).deviation; });
    table.column(
        name + "_p", "p", [of](auto &curve) { return of(curve).p; }, 2);
  }
  table.comment(
      "departure: of the cumulative number of events from a straight line, over their number; "
      "steady_p: share of series of the same times, in blocks in random order, that depart as far");
  table.comment(
      "random: mean and standard deviation of independent exponential times (variation, "
      "burstiness) or of the times in random order; p: share of them as far from their mean");
  for (const IntervalCurve &curve : curves) table.row(curve);
  return Table(std::move(table));
}

Table interval_fit_table(const std::vector<IntervalCurve> &curves, bool rescaled) {
  struct Line {
    const IntervalCurve &curve;
    const IntervalFit &of;
    const GeneralisedGammaFit &fit = of.fit;
  };
  const auto method = [](const Line &line) {
    const double held = line.of.held;
    return std::isnan(held) ? line.of.method
                            : fmt::format("{}, δ = {} held", line.of.method, short_number(held));
  };
  TableOf<Line> table;
  table.show("fits", [](auto &line) { return line.curve.label; });
  table.show("", [](auto &line) { return line.curve.from(); });
  table.show("", method);
  table.data("threshold", [](auto &line) { return line.curve.threshold.size; });
  table.column("n", "times", [](auto &line) { return line.fit.n; });
  table.column("gamma", "γ", [](auto &l) { return Measured{l.fit.gamma, l.fit.se_gamma}; });
  table.column("delta", "δ", [](auto &l) { return Measured{l.fit.delta, l.fit.se_delta}; });
  table.column("B", "B", [](auto &line) { return Measured{line.fit.B, line.fit.se_B}; });
  table.column("C", "C", [](auto &line) { return Measured{line.fit.C, line.fit.se_C}; });
  table.column(
      "chi2_per_dof", "χ²/dof", [](auto &line) { return line.fit.chi2 / line.fit.dof; }, 3);
  table.column(
      "ks", "KS", [](auto &line) { return line.fit.ks; }, 3);
  table.column(
      "p", "p", [](auto &line) { return line.of.p; }, 2);
  table.column("rejected", "rejected", [](auto &line) {
    return std::isnan(line.of.p.value) ? "" : line.of.rejected() ? "yes" : "no";
  });
  table.data("source", [](auto &line) { return line.curve.label; });
  table.data("method", method);
  table.column(
      "shortest", "from", [](auto &line) { return line.fit.lo; }, 3);
  table.column("degenerate", "degenerate", [](auto &line) { return line.fit.why; });
  table.comment(
      fmt::format("f(theta) = C theta^(gamma-1) exp(-theta^delta / B), theta in {}",
                  rescaled ? "multiples of the mean" : "model time, of earthquakes days"));
  table.comment(
      "to quote: maximum likelihood with delta = 1 held; least squares with C free is what the "
      "paper did");
  table.comment(
      "rejected: p below 0.05. p is the probability of a fit as poor or poorer if the times are "
      "independent and follow the fitted density: least squares from χ² and its degrees of freedom "
      "(dof), maximum likelihood as the share of synthetic samples, each fitted like the data, whose "
      "Kolmogorov-Smirnov distance KS is as large");
  for (const IntervalCurve &curve : curves)
    for (const IntervalFit &fit : curve.fits) table.row({curve, fit});
  return Table(std::move(table));
}

}  // namespace LSM::postproc
