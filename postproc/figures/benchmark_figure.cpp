// SPDX-License-Identifier: GPL-2.0-or-later
#include "benchmark_figure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

bool near_one_of(const std::vector<double> &places, double x) {
  return std::any_of(places.begin(), places.end(), [x](double place) {
    return std::fabs(place - x) <= 1e-9 * std::max(1.0, std::fabs(x));
  });
}

StationCurve at_place(const NamedCurves &run, double x) {
  const auto right = std::find_if(run.stations.begin(), run.stations.end(), [x](const auto &s) {
    return s.x >= x - 1e-9 * std::max(1.0, std::fabs(x));
  });
  if (right == run.stations.end() || (right == run.stations.begin() && !near_one_of({x}, right->x)))
    throw std::invalid_argument(fmt::format(
        "{}: no slip at x = {}, which runs from {} to {}", run.name, short_number(x, 8),
        short_number(run.stations.front().x, 8), short_number(run.stations.back().x, 8)));
  if (near_one_of({x}, right->x)) return *right;
  const StationCurve &a = *(right - 1), &b = *right;
  const double part = (x - a.x) / (b.x - a.x);
  StationCurve between = a;
  between.x = x;
  for (std::size_t n = 0; n < a.t.size(); ++n) {
    between.slip[n] += part * (b.slip[n] - a.slip[n]);
    between.rate[n] += part * (b.rate[n] - a.rate[n]);
  }
  return between;
}

Table misfit_table() {
  return Table(
      "run,spacing,reference,x,arrival,reference_arrival,end_slip,reference_end_slip,"
      "slip_l2,peak_rate,reference_peak_rate,rate_l2");
}

void add_misfit(Table &table, const NamedCurves &run, const std::string &reference,
                const StationMisfit &m) {
  table.row(run.name, run.spacing, reference, m.x, m.arrival, m.reference_arrival, m.end_slip,
            m.reference_end_slip, m.slip_l2, m.peak, m.reference_peak, m.rate_l2);
}

namespace {

constexpr std::size_t most_panels = 6;

std::vector<double> common_places(const BenchmarkCurves &references) {
  std::vector<double> common;
  for (const StationCurve &station : references.front().stations) {
    const bool everywhere =
        std::all_of(references.begin(), references.end(), [&station](const NamedCurves &r) {
          return std::any_of(r.stations.begin(), r.stations.end(),
                             [&station](const auto &s) { return near_one_of({s.x}, station.x); });
        });
    if (everywhere) common.push_back(station.x);
  }
  std::sort(common.begin(), common.end());
  // evenly, if there are more than fit
  std::vector<double> some;
  const std::size_t n = std::min(common.size(), most_panels);
  for (std::size_t k = 0; k < n; ++k)
    some.push_back(common[n > 1 ? k * (common.size() - 1) / (n - 1) : 0]);
  return some;
}

/// Distance of ticks of an axis from 0 to most, about three of them.
double tick(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most / 3.0)));
  const double part = most / 3.0 / decade;
  return decade * (part < 2.0 ? 1.0 : part < 5.0 ? 2.0 : 5.0);
}

void add_curve(Table &table, std::int64_t number, const StationCurve &curve, double until) {
  for (std::size_t n = 0; n < curve.t.size() && curve.t[n] <= until; ++n)
    table.row(number, curve.x, curve.t[n], curve.slip[n], curve.rate[n]);
}

void add_front(Table &table, std::int64_t number, const NamedCurves &curves, double rate) {
  for (const StationCurve &station : curves.stations)
    table.row(-number, station.x, arrival(station, rate), std::nan(""), std::nan(""));
}

/// Elements of a plot command: all curves at a place, or their fronts.
std::string plots(const BenchmarkCurves &runs, const BenchmarkCurves &references,
                  const std::string &x, const std::string &column, bool front, bool titles) {
  std::string all;
  std::int64_t number = 1;
  const auto element = [&](const NamedCurves &curves, const std::string &style) {
    const std::string which =
        front ? fmt::format("$1 == {}", -number) : fmt::format("$1 == {} && $2 == {}", number, x);
    all += fmt::format("{}table using ({} ? {} : NaN):{} with {} {}",
                       all.empty() ? "" : ", \\\n     ", which, front ? "$2 / 1000" : "$3", column,
                       style, titles ? "title " + quote(curves.name) : "notitle");
    ++number;
  };
  for (std::size_t n = 0; n < references.size(); ++n)
    element(references[n],
            front ? fmt::format("points lt {} ps 1.1*point", n == 0 ? 8 : 7 - n)
                  : fmt::format("lines lt 8 dt {} lw {} lc rgb '{}'", n == 0 ? "1" : "(8,4)",
                                n == 0 ? 2.6 : 1.6, n == 0 ? "#999999" : "#000000"));
  for (std::size_t n = 0; n < runs.size(); ++n)
    element(runs[n], fmt::format("lines lt {} dt 1 lw 1.1", n + 1));
  return all;
}

}  // namespace

Figure benchmark_figure(const BenchmarkCurves &runs, const BenchmarkCurves &references,
                        const std::vector<double> &places, double rate, double until) {
  const std::vector<double> shown = places.empty() ? common_places(references) : places;
  Table table("number,x,t,slip,slip_rate");
  table.comment("number n > 0: curve n at x; -n: arrival of curve n at x");
  std::int64_t number = 1;
  double end = 0.0;
  for (const BenchmarkCurves *group : {&references, &runs})
    for (const NamedCurves &curves : *group) {
      table.comment(fmt::format("curve {}: {}", number, curves.name));
      for (const double x : shown) {
        if (group == &runs) {
          add_curve(table, number, at_place(curves, x), until);
          end = std::max(end, std::min(until, curves.stations.front().t.back()));
        } else {
          for (const StationCurve &station : curves.stations)
            if (near_one_of({x}, station.x)) add_curve(table, number, station, until);
        }
      }
      add_front(table, number++, curves, rate);
    }

  const auto rows = static_cast<int>(shown.size());
  const int height = 150 * rows + 400;
  const double panels = 150.0 * rows / height, top = 0.985;
  std::string script =
      fmt::format("set multiplot\nset xrange [0:{}]\nunset key\n", text_io::number(end));
  for (int n = 0; n < rows; ++n) {
    const std::string x = text_io::number(shown[static_cast<std::size_t>(n)]);
    const double high = top - panels * n / rows, low = top - panels * (n + 0.86) / rows;
    script += fmt::format("set format x '{}'\nset xlabel ''\n", n + 1 == rows ? "%g" : "");
    double most[2] = {0.0, 0.0};  // of slip and slip rate
    for (const BenchmarkCurves *group : {&references, &runs})
      for (const NamedCurves &curves : *group)
        for (const StationCurve &station : curves.stations) {
          if (!near_one_of({shown[static_cast<std::size_t>(n)]}, station.x)) continue;
          most[0] = std::max(most[0], *std::max_element(station.slip.begin(), station.slip.end()));
          most[1] = std::max(most[1], *std::max_element(station.rate.begin(), station.rate.end()));
        }
    for (const bool right : {false, true}) {
      script += fmt::format(
          "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {:.4f}\n"
          "set bmargin at screen {:.4f}\nset ylabel '{}' offset 1,0\nset yrange [0:{}]\nset ytics "
          "{}\n"
          "set label 1 {} at graph {},0.86 {}\n",
          right ? 0.58 : 0.08, right ? 0.985 : 0.485, high, low,
          right ? "Slip rate (m/s)" : "Slip (m)", text_io::number(1.1 * most[right]),
          text_io::number(tick(most[right])),
          quote(fmt::format("x = {:g} km", shown[static_cast<std::size_t>(n)] / 1000.0)),
          right ? 0.98 : 0.03, right ? "right" : "left");
      script += "plot " + plots(runs, references, x, right ? "5" : "4", false, false) + "\n";
    }
  }
  script += fmt::format(
      "unset label 1\nset lmargin at screen 0.08\nset rmargin at screen 0.985\n"
      "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset xrange [*:*]\n"
      "set yrange [*:*]\nset ytics autofreq\nset format x '%g'\nset xlabel 'Place along the fault "
      "(km); panels above: time (s)'\n"
      "set ylabel 'Arrival (s)' offset 1,0\nset key at screen 0.5,0.004 bottom center horizontal "
      "maxcols 4 samplen 2 noreverse Right\nplot {}\nunset multiplot\n",
      top - panels - 30.0 / height, 150.0 / height, plots(runs, references, "", "3", true, true));
  return {std::move(table), script, {1000, height}};
}

}  // namespace LSM::postproc
