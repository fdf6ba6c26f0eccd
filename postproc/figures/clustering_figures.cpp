// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr std::size_t most_rows = 8;
constexpr int row_height = 290;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<const IntervalCurve *> drawn(const std::vector<IntervalCurve> &curves) {
  std::vector<const IntervalCurve *> out;
  for (const IntervalCurve &curve : curves)
    if (has_clustering(curve) && out.size() < most_rows) out.push_back(&curve);
  if (out.empty())
    throw std::runtime_error("no curve has enough times to tell whether they cluster");
  return out;
}

std::string title_of(const IntervalCurve &curve) { return curve.label + ", " + curve.from(); }

/// Earthquakes: the year, with its fraction.
double shown_time(const IntervalCurve &curve, double time) {
  return curve.earthquakes ? 1970.0 + time / 365.2425 : time;
}

/// gnuplot margins of a row, as shares of the picture. Room for a label of the axis is in pixels.
std::string place(std::size_t row, std::size_t rows, double left, double right) {
  const double height = 1.0 / static_cast<double>(rows);
  const double top = 1.0 - static_cast<double>(row) * height;
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
      "set bmargin at screen {}\n",
      left, right, top - 0.12 * height, top - 0.72 * height);
}

std::string linear_axes() {
  return "unset logscale\nset format '%g'\nset xtics autofreq\nset ytics autofreq\n"
         "unset mxtics\nunset mytics\nset autoscale\nset title ''\n";
}

}  // namespace

bool has_clustering(const IntervalCurve &curve) {
  return !std::isnan(curve.clustering.burstiness) && curve.starts.size() >= 20;
}

Figure rate_figure(const std::vector<IntervalCurve> &curves) {
  const std::vector<const IntervalCurve *> rows = drawn(curves);
  Figure figure{Table("curve,kind,time,to,count,departure,label"),
                "set multiplot\n",
                {900, row_height * static_cast<int>(rows.size())}};
  figure.table.comment(
      "count: cumulative number of events at 400 times; steady: periods proposed as steady, "
      "their events and departure from a straight line over that number; earthquakes: year");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const IntervalCurve &curve = *rows[k];
    const auto number = static_cast<std::int64_t>(k + 1);
    const std::vector<double> &starts = curve.starts;
    const double from = starts.front(), to = starts.back();
    constexpr int points = 400;
    for (int i = 0; i <= points; ++i) {
      const double time = i == points ? to : from + (to - from) * i / points;
      const auto count = static_cast<std::int64_t>(
          std::upper_bound(starts.begin(), starts.end(), time) - starts.begin());
      figure.table.row(number, "count", shown_time(curve, time), nan, count, nan, curve.label);
    }
    std::string bands = "unset object\nunset label\n";
    int band = 0;
    for (const Stretch &one : curve.steadiness.steady) {
      const double left = shown_time(curve, one.from), right = shown_time(curve, one.to);
      figure.table.row(number, "steady", left, right, one.n, one.departure, curve.label);
      ++band;
      bands += fmt::format(
          "set object {0} rect from {1}, graph 0 to {2}, graph 1 fc rgb '#009e73' fs solid 0.18 "
          "noborder behind\nset label {0} '{3}' at {4}, graph 0.08 center\n",
          band, text_io::number(left), text_io::number(right), one.n,
          text_io::number(0.5 * (left + right)));
    }
    const auto n = text_io::number(static_cast<double>(starts.size()));
    const std::string first = text_io::number(shown_time(curve, from)),
                      last = text_io::number(shown_time(curve, to));
    figure.script +=
        linear_axes() + place(k, rows.size(), 0.1, 0.97) + bands +
        fmt::format("set title {} offset 0,-0.6\n",
                    quote(fmt::format("{}: departure {}{}", title_of(curve),
                                      short_number(curve.steadiness.whole.departure, 2),
                                      std::isnan(curve.steadiness.p)
                                          ? std::string()
                                          : fmt::format(", p = {} for a steady rate",
                                                        short_number(curve.steadiness.p, 2))))) +
        axis("x", curve.earthquakes ? "year" : "time (model time units)", false,
             shown_time(curve, from), shown_time(curve, to)) +
        axis("y", "events", false, 0.0, nan) +
        fmt::format(
            "plot table using ($1 == {0} && strcol(2) eq 'count' ? $3 : NaN):5 with lines lt 1 lw "
            "1.5 notitle, \\\n     [{1}:{2}] '+' using 1:({3}*($1-({1}))/(({2})-({1}))) with lines "
            "lt 8 dt (6,4) notitle\n",
            number, first, last, n);
  }
  figure.script += "unset multiplot\n";
  return figure;
}

Figure conditional_figure(const std::vector<IntervalCurve> &curves) {
  const std::vector<const IntervalCurve *> rows = drawn(curves);
  Figure figure{Table("curve,kind,part,x,y,error,random,random_deviation,label"),
                "set multiplot\n" + std::string(error_bar_function),
                {900, (row_height + 50) * static_cast<int>(rows.size())}};
  figure.table.comment(
      "density: of the times over their mean that follow the shortest (part 1), middle (2) and "
      "longest (3) third of the times; mean: of those that follow each eighth, over the mean, "
      "beside times in random order (Livina et al. 2005)");
  const auto add = [&figure](std::int64_t curve, const char *kind, std::size_t part, double x,
                             double y, double error, double random, double deviation,
                             const std::string &label) {
    figure.table.row(curve, kind, part, x, y, error, random, deviation, label);
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const IntervalCurve &curve = *rows[k];
    const auto number = static_cast<std::int64_t>(k + 1);
    Extent times, heights;
    for (std::size_t third = 0; third < thirds; ++third)
      for (const LogBin &bin : curve.after[third]) {
        if (bin.count == 0) continue;
        add(number, "density", third + 1, bin.centre, bin.density, bin.error, nan, nan,
            curve.label);
        heights.add(bin.density);
        times.add(bin.lo);
        times.add(bin.hi);
      }
    for (std::size_t part = 0; part < eighths; ++part) {
      const AgainstChance &one = curve.clustering.after_eighth[part];
      add(number, "mean", part + 1, static_cast<double>(part + 1), one.value, nan, one.mean,
          one.deviation, curve.label);
    }
    const AgainstChance &apart = curve.clustering.after_distance;
    std::string densities;
    const char *const names[] = {"after the shortest third", "middle", "longest"};
    constexpr int colours[] = {6, 8, 1};
    for (std::size_t third = 0; third < thirds; ++third)
      densities += fmt::format(
          "{} table using ($1 == {} && strcol(2) eq 'density' && $3 == {} ? $4 : NaN):5 with "
          "linespoints lt {} ps 0.8 title '{}'",
          third == 0 ? "plot" : ", \\\n    ", number, third + 1, colours[third], names[third]);
    const std::string eighth = fmt::format("($1 == {} && strcol(2) eq 'mean' ? $4 : NaN)", number);
    figure.script +=
        linear_axes() + place(k, rows.size(), 0.1, 0.56) +
        fmt::format("set title {} offset 0,-0.6\nset key inside bottom left vertical noopaque\n",
                    quote(fmt::format("{} (p = {})", title_of(curve), short_number(apart.p, 2)))) +
        axis("x", "inter-event time / mean", true, times.lo, times.hi) +
        axis("y", "probability density", true, heights.lo, heights.hi) + densities + "\n" +
        linear_axes() + place(k, rows.size(), 0.7, 0.97) +
        "set key inside bottom right noopaque\n" +
        axis("x", "eighth of the previous time", false, 0.5, 8.5) +
        axis("y", "mean after it / mean", false, 0.0, nan) +
        fmt::format(
            "plot table using {0}:($7-2*$8):($7+2*$8) with filledcurves fs solid 0.2 noborder lt 8 "
            "title 'random order', \\\n     table using {0}:5 with linespoints lt 1 notitle\n",
            eighth);
  }
  figure.script += "unset multiplot\n";
  return figure;
}

}  // namespace LSM::postproc
