// SPDX-License-Identifier: GPL-2.0-or-later
#include "benchmark_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samples.h"
#include "files/text.h"

namespace LSM::postproc {

Table misfit_table(const std::vector<Misfits> &all) {
  struct Line {
    const Misfits &of;
    const StationMisfit &at;
  };
  TableOf<Line> table;
  table.column("run", "run", [](auto &line) { return line.of.run->name; });
  table.data("spacing", [](auto &line) { return line.of.run->spacing; });
  table.column("reference", "against", [](auto &line) { return line.of.reference; });
  table.column(
      "x", "x", [](auto &line) { return line.at.x; }, 6);
  table.column("arrival", "arrival", [](auto &line) { return line.at.arrival; });
  table.column("reference_arrival", "ref.", [](auto &line) { return line.at.reference_arrival; });
  table.show(
      "late", [](auto &line) { return line.at.arrival - line.at.reference_arrival; }, 3);
  table.column("end_slip", "slip", [](auto &line) { return line.at.end_slip; });
  table.column("reference_end_slip", "ref.", [](auto &line) { return line.at.reference_end_slip; });
  table.show(
      "more %", [](auto &l) { return 100.0 * (l.at.end_slip / l.at.reference_end_slip - 1.0); }, 3);
  table.column(
      "slip_l2", "L2", [](auto &line) { return line.at.slip_l2; }, 3);
  table.column("peak_rate", "peak V", [](auto &line) { return line.at.peak; });
  table.column("reference_peak_rate", "ref.", [](auto &line) { return line.at.reference_peak; });
  table.column(
      "rate_l2", "L2(V)", [](auto &line) { return line.at.rate_l2; }, 3);
  for (const Misfits &one : all)
    for (const StationMisfit &station : one.stations) table.row({one, station});
  return Table(std::move(table));
}

Table misfit_summary_table(const std::vector<Misfits> &all) {
  TableOf<Misfits> table;
  const auto percent = [](double MisfitSummary::*share) {
    return [share](const Misfits &one) { return 100.0 * one.summary.*share; };
  };
  table.column("run", "over all stations", [](auto &one) { return one.run->name; });
  table.column("spacing", "spacing", [](auto &one) { return one.run->spacing; });
  table.column("reference", "against", &Misfits::reference);
  table.column(
      "arrival", "arrival", [](auto &one) { return one.summary.arrival; }, 3);
  table.column(
      "arrival_max", "max", [](auto &one) { return one.summary.largest_arrival; }, 3);
  table.column("slip", "slip %", percent(&MisfitSummary::end_slip), 3);
  table.column("slip_max", "max", percent(&MisfitSummary::largest_end_slip), 3);
  table.column("slip_l2", "L2(slip) %", percent(&MisfitSummary::slip_l2), 3);
  table.column("peak", "peak V %", percent(&MisfitSummary::peak), 3);
  table.column("rate_l2", "L2(V) %", percent(&MisfitSummary::rate_l2), 3);
  for (const Misfits &one : all) table.row(one);
  return Table(std::move(table));
}

namespace {

/// Distance of the ticks of an axis from 0 to `most`, for about three ticks.
double tick(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most / 3.0)));
  const double part = most / 3.0 / decade;
  return decade * (part < 2.0 ? 1.0 : part < 5.0 ? 2.0 : 5.0);
}

/// A curve of the figure with its number and style. References have the first numbers.
struct Numbered {
  const NamedCurves &curves;
  std::int64_t number;
  bool run;
  std::string line, mark;  ///< gnuplot styles; `mark` is empty for runs
};

std::vector<Numbered> numbered(const std::vector<NamedCurves> &runs,
                               const std::vector<NamedCurves> &references) {
  std::vector<Numbered> all;
  for (const NamedCurves &one : references) {
    const std::size_t n = all.size();
    all.push_back(
        {one, static_cast<std::int64_t>(n + 1), false,
         n == 0 ? "lt 8 dt 1 lw 2.6 lc rgb '#999999'" : "lt 8 dt (8,4) lw 1.6 lc rgb '#000000'",
         fmt::format("pt {} ps 1.1*point", n == 0 ? 12 : 6)});
  }
  for (const NamedCurves &one : runs)
    all.push_back({one, static_cast<std::int64_t>(all.size() + 1), true,
                   fmt::format("lt {} dt 1 lw 1.1", &one - runs.data() + 1), ""});
  return all;
}

/// Difference of the slip from that of the reference at the same place and time, NaN where the
/// reference has none.
std::vector<double> difference(const StationCurve &curve, const NamedCurves &reference) {
  std::vector<double> out(curve.t.size(), std::nan(""));
  for (const StationCurve &known : reference.stations) {
    if (!same_place(known.x, curve.x)) continue;
    for (std::size_t n = 0; n < out.size(); ++n)
      if (curve.t[n] >= known.t.front() && curve.t[n] <= known.t.back())
        out[n] = curve.slip[n] - interpolate(known.t, known.slip, curve.t[n]);
  }
  return out;
}

/// The curve at x; empty if a reference has none there. Runs are interpolated.
std::vector<StationCurve> curves_at(const Numbered &one, double x) {
  if (one.run) return {at_place(one.curves, x)};
  std::vector<StationCurve> out;
  for (const StationCurve &station : one.curves.stations)
    if (same_place(x, station.x)) out.push_back(station);
  return out;
}

/// Adds the curves at these places, and the arrival times at all places.
void add_rows(Table &table, const Numbered &one, const NamedCurves &reference,
              const std::vector<double> &places, double rate, double until) {
  for (const double x : places)
    for (const StationCurve &curve : curves_at(one, x)) {
      const std::vector<double> off = difference(curve, reference);
      for (std::size_t n = 0; n < curve.t.size() && curve.t[n] <= until; ++n)
        table.row(one.number, curve.x, curve.t[n], curve.slip[n], curve.rate[n], off[n]);
    }
  for (const StationCurve &station : one.curves.stations)
    table.row(-one.number, station.x, arrival(station, rate), std::nan(""), std::nan(""),
              std::nan(""));
}

/// Panels of slip, slip rate and difference of the slip from that of the reference at one place.
std::string station_panels(const std::vector<Numbered> &all, const NamedCurves &reference, double x,
                           double low, double high) {
  double most[3] = {0.0, 0.0, 0.0};
  for (const Numbered &one : all)
    for (const StationCurve &curve : curves_at(one, x)) {
      most[0] = std::max(most[0], *std::max_element(curve.slip.begin(), curve.slip.end()));
      most[1] = std::max(most[1], *std::max_element(curve.rate.begin(), curve.rate.end()));
      for (const double off : difference(curve, reference))
        if (std::isfinite(off)) most[2] = std::max(most[2], 100.0 * std::fabs(off));
    }
  constexpr const char *titles[] = {"Slip (m)", "Slip rate (m/s)", "Difference (cm)"};
  std::string script;
  for (int k = 0; k < 3; ++k) {
    const double left = 0.065 + 0.335 * k, range = std::max(1.1 * most[k], 1e-9);
    script += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {:.4f}\n"
        "set bmargin at screen {:.4f}\nset ylabel '{}' offset {},0\nset yrange [{}:{}]\n"
        "set ytics {}\nset label 1 {} at graph {},0.86 {}\n",
        left, left + 0.25, high, low, titles[k], k == 2 ? 0.5 : 1.5,
        k == 2 ? text_io::number(-range) : "0", text_io::number(range),
        text_io::number(tick(k == 2 ? 2.5 * range : range)),
        k == 2 ? "''" : quote(fmt::format("x = {:g} km", x / 1000.0)), k == 0 ? 0.03 : 0.98,
        k == 0 ? "left" : "right");
    for (const Numbered &one : all)
      script +=
          fmt::format("{}table using ($1 == {} && $2 == {} ? $3 : NaN):{} with lines {} notitle",
                      one.number == 1 ? "plot " : ", \\\n     ", one.number, text_io::number(x),
                      k == 2   ? "(100*$6)"
                      : k == 1 ? "5"
                               : "4",
                      one.line);
    script += "\n";
  }
  return script;
}

std::string arrival_panel(const std::vector<Numbered> &all, const std::string &reference,
                          double low, double high) {
  std::string script = fmt::format(
      "unset label 1\nset lmargin at screen 0.065\nset rmargin at screen 0.985\n"
      "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset xrange [*:*]\n"
      "set yrange [*:*]\nset ytics autofreq\nset format x '%g'\nset xlabel {}\nset ylabel 'Arrival "
      "(s)' offset 1,0\nset key at screen 0.5,0.004 bottom center horizontal maxcols 4 samplen 3 "
      "noreverse Right\n",
      high, low,
      quote("Place along the fault (km); above: time (s); right: slip less that of " + reference));
  for (const Numbered &one : all) {
    script += fmt::format("{}table using ($1 == {} ? $2 / 1000 : NaN):3 with ",
                          one.number == 1 ? "plot " : ", \\\n     ", -one.number);
    const std::string name = quote(one.curves.name);
    // References: the key combines their line in the panels above with their mark in this one.
    script +=
        one.run
            ? fmt::format("lines {} title {}", one.line, name)
            : fmt::format("points {} {} notitle, \\\n     keyentry with linespoints {} {} title {}",
                          one.line.substr(one.line.find("lc")), one.mark, one.line, one.mark, name);
  }
  return script + "\nunset multiplot\n";
}

}  // namespace

Figure benchmark_figure(const std::vector<NamedCurves> &runs,
                        const std::vector<NamedCurves> &references, double rate, double until) {
  const std::vector<double> shown = common_places(references, 6);
  const std::vector<Numbered> all = numbered(runs, references);
  Table table("number,x,t,slip,slip_rate,difference");
  table.comment("number n > 0: curve n at x; -n: arrival of curve n at x");
  table.comment("difference: slip less that of " + references.back().name);
  double end = 0.0;
  for (const Numbered &one : all) {
    table.comment(fmt::format("curve {}: {}", one.number, one.curves.name));
    add_rows(table, one, references.back(), shown, rate, until);
    if (one.run) end = std::max(end, std::min(until, one.curves.stations.front().t.back()));
  }
  const auto rows = static_cast<int>(shown.size());
  const int height = 150 * rows + 400;
  const double panels = 150.0 * rows / height, top = 0.985;
  std::string script =
      fmt::format("set multiplot\nset xrange [0:{}]\nunset key\n", text_io::number(end));
  for (int n = 0; n < rows; ++n) {
    script += fmt::format("set format x '{}'\nset xlabel ''\n", n + 1 == rows ? "%g" : "");
    script += station_panels(all, references.back(), shown[static_cast<std::size_t>(n)],
                             top - panels * (n + 0.86) / rows, top - panels * n / rows);
  }
  return {std::move(table),
          script + arrival_panel(all, references.back().name, 150.0 / height,
                                 top - panels - 30.0 / height),
          {1000, height}};
}

}  // namespace LSM::postproc
