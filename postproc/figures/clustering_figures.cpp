// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A number of Clustering: its column, its description, and the random series it is compared with.
struct Named {
  const char *column, *text, *random;
  AgainstChance (*number)(const Clustering &);
};

constexpr std::array<Named, 7> numbers = {
    {{"variation", "variation (standard deviation / mean)", "independent",
      [](const Clustering &c) { return c.variation; }},
     {"finite_burstiness", "burstiness, finite form", "independent",
      [](const Clustering &c) { return c.finite_burstiness; }},
     {"memory", "memory coefficient", "shuffled", [](const Clustering &c) { return c.memory; }},
     {"after_short", "mean time after the shortest third / mean", "shuffled",
      [](const Clustering &c) { return c.after[0]; }},
     {"after_middle", "after the middle third", "shuffled",
      [](const Clustering &c) { return c.after[1]; }},
     {"after_long", "after the longest third", "shuffled",
      [](const Clustering &c) { return c.after[2]; }},
     {"after_distance", "distance between times after short and long ones", "shuffled",
      [](const Clustering &c) { return c.after_distance; }}}};

std::string title_of(const IntervalCurve &curve, const std::string &more) {
  return fmt::format("set title {} offset 0,-0.6\n",
                     quote(curve.sample.label + ", " + curve.sample.from() + more));
}

/// Time as it is drawn: for earthquakes the year with its fraction, otherwise the model time.
double shown_time(const IntervalCurve &curve, double time) {
  return curve.sample.earthquakes ? 1970.0 + time / 365.2425 : time;
}

/// A row of panels for each of the first eight curves with clustering.
/// \param panels called with the table, the number of the curve (from 1), the curve, and a function
/// that begins a panel between two edges of the row; adds rows and returns gnuplot commands
/// \throws std::runtime_error if no curve has clustering
template <class Panels>
Figure in_rows(const std::vector<IntervalCurve> &curves, Table table, int height,
               const Panels &panels) {
  std::vector<const IntervalCurve *> drawn;
  for (const IntervalCurve &curve : curves)
    if (has_clustering(curve) && drawn.size() < 8) drawn.push_back(&curve);
  if (drawn.empty()) throw DegenerateData("no curve has enough times to tell whether they cluster");
  const auto rows = static_cast<int>(drawn.size());
  std::string script = "set multiplot\n";
  for (int row = 0; row < rows; ++row) {
    const double share = 1.0 / rows, top = 1.0 - row * share;
    const auto begin = [&](double left, double right) {
      return panel(left, right, top - 0.72 * share, top - 0.12 * share);
    };
    script += panels(table, row + 1, *drawn[static_cast<std::size_t>(row)], begin);
  }
  return {std::move(table), script + "unset multiplot\n", {900, height * rows}};
}

}  // namespace

bool has_clustering(const IntervalCurve &curve) {
  return !std::isnan(curve.clustering.burstiness) && curve.plot.starts.size() >= 20;
}

Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date) {
  TableOf<IntervalCurve> table;
  const auto time = [date](double Stretch::*end) {
    return [date, end](const IntervalCurve &curve) {
      const double t = curve.steadiness.whole.*end;
      return curve.sample.earthquakes && std::isfinite(t) ? date(t) : short_number(t, 6);
    };
  };
  table.column("label", "catalogue", [](auto &curve) { return curve.sample.label; });
  table.show("events", [](auto &curve) { return curve.sample.from(); });
  table.data("threshold", [](auto &curve) { return curve.sample.threshold.size; });
  table.column("n", "times", &IntervalCurve::n);
  table.show("from", time(&Stretch::from));
  table.show("to", time(&Stretch::to));
  table.data("from", [](auto &curve) { return curve.steadiness.whole.from; });
  table.data("to", [](auto &curve) { return curve.steadiness.whole.to; });
  table.column(
      "departure", "departure from a steady rate",
      [](auto &curve) { return curve.steadiness.whole.departure; }, 2);
  table.column(
      "steady_p", "p of a steady rate", [](auto &curve) { return curve.steadiness.p; }, 2);
  table.column(
      "burstiness", "burstiness", [](auto &curve) { return curve.clustering.burstiness; }, 3);
  for (const Named &one : numbers) {
    const std::string name = one.column;
    const auto of = [number = one.number](const IntervalCurve &c) { return number(c.clustering); };
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

/// Adds the periods of a curve that are proposed as steady, and returns gnuplot commands that shade
/// them.
std::string add_steady(Table &table, int number, const IntervalCurve &curve) {
  std::string areas = "unset object\nunset label\n";
  int area = 0;
  for (const Stretch &one : curve.steadiness.steady) {
    const double left = shown_time(curve, one.from), right = shown_time(curve, one.to);
    table.row(number, "steady", left, right, one.n, one.departure, curve.sample.label);
    areas += fmt::format(
        "set object {0} rect from {1}, graph 0 to {2}, graph 1 fc rgb '#009e73' fs solid 0.18 "
        "noborder behind\nset label {0} '{3}' at {4}, graph 0.08 center\n",
        ++area, text::number(left), text::number(right), one.n, text::number(0.5 * (left + right)));
  }
  return areas;
}

std::string departure_text(const Steadiness &steadiness) {
  const std::string departure = ": departure " + short_number(steadiness.whole.departure, 2);
  if (std::isnan(steadiness.p)) return departure;
  return departure + fmt::format(", p = {} for a steady rate", short_number(steadiness.p, 2));
}

}  // namespace

Figure rate_figure(const std::vector<IntervalCurve> &curves) {
  Table counts("curve,kind,time,to,count,departure,label");
  counts.comment(
      "count: cumulative number of events at 400 times; steady: periods proposed as steady, "
      "their events and departure from a straight line over that number; earthquakes: year");
  return in_rows(
      curves, std::move(counts), 290,
      [](Table &table, int number, const IntervalCurve &curve, const auto &begin_panel) {
        for (const auto &[time, count] : cumulative_numbers(curve.plot.starts, 400))
          table.row(number, "count", shown_time(curve, time), nan, count, nan, curve.sample.label);
        const double first = shown_time(curve, curve.plot.starts.front()),
                     last = shown_time(curve, curve.plot.starts.back());
        return begin_panel(0.1, 0.97) + add_steady(table, number, curve) +
               title_of(curve, departure_text(curve.steadiness)) +
               axis("x", curve.sample.earthquakes ? "year" : "time (model time units)", false,
                    first, last) +
               axis("y", "events", false, 0.0, nan) +
               fmt::format(
                   "plot table using ($1 == {0} && strcol(2) eq 'count' ? $3 : NaN):5 with lines "
                   "lt 1 lw 1.5 notitle, \\\n     [{1}:{2}] '+' using "
                   "1:({3}*($1-({1}))/(({2})-({1}))) with lines lt 8 dt (6,4) notitle\n",
                   number, text::number(first), text::number(last), curve.plot.starts.size());
      });
}

namespace {

/// Adds the densities of the times after each third of the times, and returns their panel.
std::string after_thirds(Table &table, int number, const IntervalCurve &curve) {
  constexpr const char *names[] = {"after the shortest third", "middle", "longest"};
  constexpr int colours[] = {6, 8, 1};
  Extent times, heights;
  std::string plots;
  for (std::size_t third = 0; third < thirds; ++third) {
    for (const LogBin &bin : curve.plot.after[third]) {
      if (bin.count == 0) continue;
      table.row(number, "density", third + 1, bin.centre, bin.density, bin.error, nan, nan,
                curve.sample.label);
      heights.add(bin.density);
      times.add(bin.lo);
      times.add(bin.hi);
    }
    plots += fmt::format(
        "{} table using ($1 == {} && strcol(2) eq 'density' && $3 == {} ? $4 : NaN):5 with "
        "linespoints lt {} ps 0.8 title '{}'",
        third == 0 ? "plot" : ", \\\n    ", number, third + 1, colours[third], names[third]);
  }
  return "set key inside bottom left vertical noopaque\n" +
         axis("x", "inter-event time / mean", true, times.lo, times.hi) +
         axis("y", "probability density", true, heights.lo, heights.hi) + plots + "\n";
}

/// Adds the mean time after each eighth of the times, and returns their panel.
std::string after_eighths(Table &table, int number, const IntervalCurve &curve) {
  for (std::size_t part = 0; part < eighths; ++part) {
    const AgainstChance &one = curve.clustering.after_eighth[part];
    table.row(number, "mean", part + 1, static_cast<double>(part + 1), one.value, nan, one.mean,
              one.deviation, curve.sample.label);
  }
  return "set key inside bottom right noopaque\n" +
         axis("x", "eighth of the previous time", false, 0.5, 8.5) +
         axis("y", "mean after it / mean", false, 0.0, nan) +
         fmt::format(
             "plot table using {0}:($7-2*$8):($7+2*$8) with filledcurves fs solid 0.2 noborder lt "
             "8 title 'random order', \\\n     table using {0}:5 with linespoints lt 1 notitle\n",
             fmt::format("($1 == {} && strcol(2) eq 'mean' ? $4 : NaN)", number));
}

}  // namespace

Figure conditional_figure(const std::vector<IntervalCurve> &curves) {
  Table densities("curve,kind,part,x,y,error,random,random_deviation,label");
  densities.comment(
      "density: of the times over their mean that follow the shortest (part 1), middle (2) and "
      "longest (3) third of the times; mean: of those that follow each eighth, over the mean, "
      "beside times in random order (Livina et al. 2005)");
  return in_rows(curves, std::move(densities), 340,
                 [](Table &table, int number, const IntervalCurve &curve, const auto &begin_panel) {
                   const double p = curve.clustering.after_distance.p;
                   std::string script =
                       begin_panel(0.1, 0.56) +
                       title_of(curve, fmt::format(" (p = {})", short_number(p, 2))) +
                       after_thirds(table, number, curve);
                   return script + begin_panel(0.7, 0.97) + after_eighths(table, number, curve);
                 });
}

}  // namespace LSM::postproc
