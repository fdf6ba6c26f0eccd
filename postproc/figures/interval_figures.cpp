// SPDX-License-Identifier: GPL-2.0-or-later
#include "interval_figures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

std::string source_of(const IntervalCurve &curve) {
  return curve.sample.earthquakes ? curve.sample.from()
                                  : "sizes >= " + text(curve.sample.threshold);
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
    thresholds.insert(curve.sample.threshold.size);
    sources.insert(source_of(curve));
  }
  for (const std::string &source : sources) table.comment(source);
  Curves plot("$6", "$7 > 0");
  Extent range, heights;
  std::int64_t number = 0;
  bool any_accepted = false, any_rejected = false;
  for (const IntervalCurve &curve : curves) {
    if (curve.bins.empty()) continue;
    ++number;
    for (const LogBin &bin : curve.bins) {
      table.row(number, curve.sample.model, curve.sample.threshold.size, bin, curve.sample.label);
      if (bin.count == 0) continue;
      heights.add(bin.density);
      range.add(bin.lo);
      range.add(bin.hi);
    }
    plot.add_data(number, 8, 9);
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{}{} ({} times)", curve.sample.label,
                         thresholds.size() > 1 ? ", " + curve.sample.from() : "", curve.n));
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
  const bool days = std::all_of(curves.begin(), curves.end(),
                                [](auto &curve) { return curve.sample.earthquakes; });
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

Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date) {
  TableOf<IntervalCurve> table;
  const auto time = [date](double Steadiness::*end) {
    return [date, end](const IntervalCurve &curve) {
      const double t = curve.steadiness.*end;
      return curve.sample.earthquakes && std::isfinite(t) ? date(t) : short_number(t, 6);
    };
  };
  table.column("label", "catalogue", [](auto &curve) { return curve.sample.label; });
  table.show("events", [](auto &curve) { return curve.sample.from(); });
  table.data("threshold", [](auto &curve) { return curve.sample.threshold.size; });
  table.column("n", "times", &IntervalCurve::n);
  table.show("from", time(&Steadiness::from));
  table.show("to", time(&Steadiness::to));
  table.data("from", [](auto &curve) { return curve.steadiness.from; });
  table.data("to", [](auto &curve) { return curve.steadiness.to; });
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

namespace {

/// A row of the paper's Table 1: gamma, delta, B and C with the digits printed there.
struct PrintedRow {
  std::string source;
  std::array<std::string, 4> parameters;
};
const std::array<PrintedRow, 3> printed_rows = {
    {{"seismicity (Corral 2004)", {"0.67", "0.98", "1.58", "0.50"}},
     {"LSM", {"0.995", "1.00", "15.21", "0.0573"}},
     {"Block-Slider", {"0.0", "1.00", "100.0", "0.25"}}}};

/// One of our fits, or a printed row.
struct Table1Line {
  const IntervalCurve &curve;
  const IntervalFit &of;
  const PrintedRow *printed = nullptr;
  const GeneralisedGammaFit &fit = of.fit;

  std::string source() const { return printed ? printed->source : curve.sample.label; }
  std::string from() const { return printed ? "" : curve.sample.from(); }
  std::string method() const {
    return std::isnan(of.held) || printed
               ? of.method
               : fmt::format("{}, δ = {} held", of.method, short_number(of.held));
  }
  Cell times() const { return printed ? Cell(std::string()) : Cell(fit.n); }
  double ours(double number) const { return printed ? NAN : number; }
  double shortest() const { return ours(fit.lo); }
  Cell parameter(std::size_t k) const {
    const Measured found[] = {
        {fit.gamma, fit.se_gamma}, {fit.delta, fit.se_delta}, {fit.B, fit.se_B}, {fit.C, fit.se_C}};
    return printed ? Cell(printed->parameters[k]) : Cell(found[k]);
  }
  std::string rejected() const {
    return std::isnan(of.p.value) ? "" : of.rejected() ? "yes" : "no";
  }
};

}  // namespace

Table table1(const std::vector<IntervalCurve> &curves, bool rescaled, bool printed) {
  TableOf<Table1Line> table;
  const auto parameter = [](std::size_t k) {
    return [k](const Table1Line &line) { return line.parameter(k); };
  };
  table.column("origin", "Table 1", [](auto &line) { return line.printed ? "printed" : "ours"; });
  table.show("", &Table1Line::source);
  table.show("", &Table1Line::from);
  table.show("", &Table1Line::method);
  table.data("threshold", [](auto &line) { return line.ours(line.curve.sample.threshold.size); });
  table.column("n", "times", &Table1Line::times);
  table.column("gamma", "γ", parameter(0), 4, true);
  table.column("delta", "δ", parameter(1), 4, true);
  table.column("B", "B", parameter(2), 4, true);
  table.column("C", "C", parameter(3), 4, true);
  table.show("from", &Table1Line::shortest, 3);
  table.column(
      "chi2_per_dof", "χ²/dof", [](auto &line) { return line.fit.chi2 / line.fit.dof; }, 3);
  table.column(
      "ks", "KS", [](auto &line) { return line.fit.ks; }, 3);
  table.column(
      "p", "p", [](auto &line) { return line.of.p; }, 2);
  table.column("rejected", "rejected", &Table1Line::rejected);
  table.data("source", &Table1Line::source);
  table.data("method", &Table1Line::method);
  table.data("shortest", &Table1Line::shortest);
  table.column("degenerate", "degenerate", [](auto &line) { return line.fit.why; });
  table.comment("f(theta) = C theta^(gamma-1) exp(-theta^delta / B)");
  table.comment(
      fmt::format("printed: Table 1 of the paper, unit of theta not stated; ours: theta in {}",
                  rescaled ? "multiples of the mean" : "model time, of earthquakes days"));
  table.comment(
      "to quote: maximum likelihood with delta = 1 held; least squares with C free is what the "
      "paper did");
  table.comment(
      "rejected: p below 0.05. p is the probability of a fit as poor or poorer if the times are "
      "independent and follow the fitted density: least squares from χ² and its degrees of freedom "
      "(dof), maximum likelihood as the share of synthetic samples, each fitted like the data, whose "
      "Kolmogorov-Smirnov distance KS is as large");
  const IntervalCurve no_curve = {};
  const IntervalFit no_fit = {};
  if (printed)
    for (const PrintedRow &row : printed_rows) table.row({no_curve, no_fit, &row});
  for (const IntervalCurve &curve : curves)
    for (const IntervalFit &fit : curve.fits) table.row({curve, fit});
  return Table(std::move(table));
}

}  // namespace LSM::postproc
