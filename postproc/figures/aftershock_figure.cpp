// SPDX-License-Identifier: GPL-2.0-or-later
#include "aftershock_figure.h"

#include <algorithm>

#include <fmt/format.h>

namespace LSM::postproc {

Table aftershock_table(const std::vector<AftershockCurve> &curves) {
  struct Line {
    const AftershockCurve &of;
    const SequenceRule &rule = of.aftershocks.rule;
    const Sequences &sequences = of.aftershocks.sequences;
    const OmoriFit &fit = of.aftershocks.fit;
  };
  TableOf<Line> table;
  table.show("catalogue", [](auto &line) { return line.of.label; });
  table.data("model", [](auto &line) { return line.of.model; });
  table.column("main_size", "smallest main shock", [](auto &line) { return line.rule.main_size; });
  table.data("least_size", [](auto &line) { return line.rule.least_size; });
  table.column("window", "largest for so long before and after",
               [](auto &line) { return line.rule.window; });
  table.data("first", [](auto &line) { return line.rule.first; });
  table.column("main_shocks", "main shocks", [](auto &line) { return line.sequences.main_shocks; });
  table.show("smallest event", [](auto &line) { return line.rule.least_size; });
  table.show("counted from", [](auto &line) { return line.rule.first; });
  table.column("events", "events after main shocks", [](auto &line) { return line.fit.n; });
  table.show("events as long before", [](auto &line) { return line.sequences.before.size(); });
  table.column("constant", "constant rate", [](auto &line) { return line.fit.constant; });
  table.column("p", "p", [](auto &line) { return line.fit.p; });
  table.column("c", "c", [](auto &line) { return line.fit.c; });
  table.column("K", "K", [](auto &line) { return line.fit.K; });
  table.column("background", "background", [](auto &line) { return line.fit.background; });
  table.show("degenerate", [](auto &line) { return line.fit.why; });
  table.column("likelihood_ratio", "2 ln L ratio against a constant rate",
               [](auto &line) { return line.fit.likelihood_ratio; });
  table.column(
      "poisson_p", "share of Poisson catalogues as large",
      [](auto &line) { return line.of.aftershocks.p; }, 2);
  table.data("label", [](auto &line) { return line.of.label; });
  table.data("degenerate", [](auto &line) { return line.fit.why; });
  table.data("before", [](auto &line) { return line.sequences.before.size(); });
  table.comment("before: events as long before the main shocks");
  table.comment(
      "n(t) = K (t + c)^-p + background after the end of a main shock, in model time (earthquakes: "
      "days)");
  table.comment("poisson_p: share of Poisson catalogues whose likelihood ratio is as large");
  for (const AftershockCurve &curve : curves) table.row({curve});
  return Table(std::move(table));
}

Figure aftershock_figure(const std::vector<AftershockCurve> &curves) {
  Table table(
      "curve,model,bin_lo,bin_hi,time,count,rate,error,poisson_rate,poisson_scatter,label,before");
  table.comment(
      "rate of events per main shock and model time (earthquakes: day), from the end of the main "
      "shock");
  table.comment("before: events as long before the start of a main shock, by their ends");
  table.comment("error: Poisson; poisson_*: mean and standard deviation in Poisson catalogues");
  Curves plot("$5");
  Extent times, rates;
  std::int64_t number = 0;
  for (const AftershockCurve &curve : curves) {
    const Aftershocks &a = curve.aftershocks;
    if (a.bins.empty()) continue;
    ++number;
    for (const RateBin &bin : a.bins) {
      table.row(number, curve.model, bin.lo, bin.hi, bin.centre, bin.count, bin.rate, bin.error,
                bin.poisson, bin.scatter, curve.label, bin.before);
      times.add(bin.lo);
      times.add(bin.hi);
      if (bin.count > 0) rates.add(bin.rate);
      if (bin.poisson > 0.0) rates.add(bin.poisson);
    }
    // A band of two standard deviations. A logarithmic axis has no zero: where the band would reach
    // it, it ends at a tenth of the mean.
    plot.add(Curves::areas,
             fmt::format("table using (row({0})):($9 > 0 ? ($9-2*$10 > 0.1*$9 ? $9-2*$10 : 0.1*$9) "
                         ": NaN):($9 > 0 ? $9+2*$10 : NaN) with filledcurves fs solid 0.15 "
                         "noborder lt {0}",
                         number));
    plot.add_data(number, 7, 8);
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{} ({} events, {} main shocks)", curve.label, a.fit.n,
                         a.sequences.main_shocks));
    const auto exact = [](const Measured &one) { return text::number(one.value); };
    const OmoriFit &fit = a.fit;
    plot.add_law(a.bins.front().lo, a.bins.back().hi,
                 fit.degenerate ? exact(fit.constant)
                                : fmt::format("{}*($1+{})**(-{})+{}", exact(fit.K), exact(fit.c),
                                              exact(fit.p), exact(fit.background)),
                 fmt::format("lt {} dt {}", number, fit.degenerate ? 2 : 1));
  }
  if (number == 0)
    throw DegenerateData("no event after a main shock in any catalogue, nothing to draw");
  plot.add(Curves::legend, "keyentry with lines lt 8",
           "lines: Omori-Utsu law; dashed: constant rate");
  plot.add(Curves::legend, "keyentry with boxes fs solid 0.15 noborder lt 8",
           "bands: Poisson catalogues, mean ± 2 standard deviations");
  const bool days = std::all_of(curves.begin(), curves.end(),
                                [](auto &curve) { return curve.model == seismicity; });
  return plot.figure(std::move(table), axis("x",
                                            std::string("time after the end of a main shock (") +
                                                (days ? "days" : "model time") + ")",
                                            true, times.lo, times.hi) +
                                           axis("y", "events per main shock and time unit", true,
                                                0.5 * rates.lo, 1.5 * rates.hi));
}

}  // namespace LSM::postproc
