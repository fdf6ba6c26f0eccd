// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitude_figure.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "numbers.h"

namespace LSM::postproc {

Table magnitude_table(const std::vector<MagnitudeCurve> &curves) {
  TableOf<MagnitudeCurve> table;
  table.show("catalogue", &MagnitudeCurve::label);
  table.show("magnitudes", [](auto &c) { return c.magnitudes.size(); });
  table.data("model", &MagnitudeCurve::model);
  table.column("completeness", "complete from", &MagnitudeCurve::completeness);
  table.show("by", &MagnitudeCurve::completeness_text);
  table.column("maximum_curvature", "maximum curvature", &MagnitudeCurve::curvature);
  table.column("n", "used for b", [](auto &c) { return c.b.n; });
  table.column("b", "b", [](auto &c) { return Measured{c.b.b, c.b.error}; });
  table.show("degenerate", [](auto &c) { return c.b.why; });
  table.show("exponent of the sizes 1 + 2 b / 3", [](auto &c) {
    return Measured{1.0 + 2.0 / 3.0 * c.b.b, 2.0 / 3.0 * c.b.error};
  });
  table.column("n_positive", "used for b-positive", [](auto &c) { return c.positive.n; });
  table.column("b_positive", "b-positive", [](auto &c) {
    return Measured{c.positive.b, c.positive.error};
  });
  table.data("label", &MagnitudeCurve::label);
  table.data("degenerate", [](auto &c) { return c.b.why; });
  table.column("degenerate_positive", "degenerate", [](auto &c) { return c.positive.why; });
  std::vector<std::string> bins;
  for (const MagnitudeCurve &curve : curves)
    if (std::string one = text(curve.bins); std::find(bins.begin(), bins.end(), one) == bins.end())
      bins.push_back(std::move(one));
  table.comment(fmt::format(
      "M of earthquakes as in the file, of models (2/3) log10(size); bins of {} (0: none)",
      fmt::join(bins, ", ")));
  table.comment(
      "b: Aki, in bins Tinti and Mulargia; errors: Shi and Bolt; b_positive: van der Elst");
  for (const MagnitudeCurve &curve : curves) table.row(curve);
  return Table(std::move(table));
}

Figure magnitude_figure(const std::vector<MagnitudeCurve> &curves) {
  Table table("curve,model,magnitude,count,from_here_on,label");
  table.comment("count: events in the bin centred at magnitude; from_here_on: in it and above");
  Curves plot("$3");
  Range magnitudes;
  double most = 0.0, margin = 0.0;
  std::int64_t number = 0;
  for (const MagnitudeCurve &curve : curves) {
    if (curve.magnitudes.empty()) continue;
    ++number;
    most = std::max(most, static_cast<double>(curve.magnitudes.size()));
    for (const MagnitudeCount &bin : magnitude_counts(curve.magnitudes, curve.counting)) {
      magnitudes.add(bin.magnitude);
      table.row(number, curve.model, bin.magnitude, bin.count, bin.from_here_on, curve.label);
    }
    // The cumulative number counts from the lower edge of the bin, half a width below its centre.
    plot.add(Curves::data, fmt::format("table using (row({0})-{1}):5 with points lt {0}", number,
                                       text::number(0.5 * curve.counting.width)));
    plot.add(Curves::data,
             fmt::format("table using ($4 > 0 ? row({0}) : NaN):4 with points lt {0} ps 0.45*point",
                         number));
    margin = std::max(margin, curve.counting.width);
    const BValue &b = curve.b;
    plot.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
             fmt::format("{} ({} events){}", curve.label, curve.magnitudes.size(),
                         b.degenerate ? "" : ": b = " + with_error(b.b, b.error, " ± ")));
    if (b.degenerate) continue;
    // The law, too, counts from the lower edge of its first bin.
    const double lowest = curve.completeness - 0.5 * curve.bins.width;
    plot.add_law(
        lowest, *std::max_element(curve.magnitudes.begin(), curve.magnitudes.end()),
        fmt::format("{}*10**(-({})*($1-({})))", b.n, text::number(b.b), text::number(lowest)),
        fmt::format("lt {}", number));
  }
  if (number == 0)
    throw DegenerateData("no event with a magnitude in any catalogue, nothing to draw");
  plot.add(Curves::legend, "keyentry with points lt 8 pt 7",
           "large: events from M on; lines: the fitted laws");
  plot.add(Curves::legend, "keyentry with points lt 8 pt 7 ps 0.45*point",
           "small: events in a bin");
  margin += 0.03 * (magnitudes.hi - magnitudes.lo);
  return plot.figure(std::move(table), axis("x", "magnitude M", false, magnitudes.lo - margin,
                                            magnitudes.hi + margin) +
                                           axis("y", "events", true, 0.8, most));
}

}  // namespace LSM::postproc
