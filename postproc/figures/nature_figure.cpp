// SPDX-License-Identifier: GPL-2.0-or-later
#include "nature_figure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace LSM::postproc {

namespace {

struct Compared {
  const char *name, *title;
  Measured NatureRow::*member;
};

constexpr std::array<Compared, 10> compared = {
    {{"distance", "distance", &NatureRow::distance},
     {"gamma", "γ", &NatureRow::gamma},
     {"variation", "variation", &NatureRow::variation},
     {"burstiness", "burstiness", &NatureRow::burstiness},
     {"memory", "memory", &NatureRow::memory},
     {"after_short", "after short", &NatureRow::after_short},
     {"before", "before large", &NatureRow::before},
     {"after", "after large", &NatureRow::after},
     {"b", "b", &NatureRow::b},
     {"size_distance", "sizes", &NatureRow::size_distance}}};

std::string name_of(const NatureRow &row) { return row.label + ", " + row.from; }

/// As name_of() but shorter, for an axis.
std::string short_name_of(const NatureRow &row) {
  return row.label + (row.earthquakes ? ", M" : ",") + row.from.substr(row.from.find(' '));
}

}  // namespace

Table nature_table(const std::vector<NatureRow> &rows) {
  TableOf<NatureRow> table;
  table.show("", name_of);
  table.data("label", &NatureRow::label);
  table.data("threshold", &NatureRow::threshold);
  table.column("catalogues", "catalogues", &NatureRow::catalogues);
  table.column("events", "events", &NatureRow::n);
  for (const Compared &one : compared) table.column(one.name, one.title, one.member, 3);
  table.comment(
      "distance: Kolmogorov-Smirnov distance of the inter-event times over their mean to those of "
      "the first row, size_distance: of the magnitudes above the smallest, over their mean");
  table.comment(
      "after_short: mean time after the shortest third over the mean; before, after: events "
      "within a mean time of large ones, over that of any others; b: Aki");
  table.comment(
      "errors: from the scatter between catalogues of a label, or for one catalogue its own "
      "(distances: blocks of consecutive values resampled)");
  for (const NatureRow &row : rows) table.row(row);
  return Table(std::move(table));
}

std::vector<Table1Row> nature_table1(const std::vector<NatureRow> &rows) {
  std::vector<Table1Row> out;
  for (const NatureRow &row : rows)
    for (const bool held : {false, true}) {
      Table1Row one;
      one.source = row.label;
      one.from = row.from;
      one.method = fmt::format("maximum likelihood{}, {} catalogue{}", held ? ", δ = 1 held" : "",
                               row.catalogues, row.catalogues == 1 ? "" : "s");
      one.threshold = row.threshold;
      one.n = row.n;
      if (!held && row.without_delta > 0)
        one.why = row.catalogues == 1 ? row.why
                                      : fmt::format("in {} of {} catalogues: {}", row.without_delta,
                                                    row.catalogues, row.why);
      else if (std::isnan(row.gamma.value))
        one.why = "the times do not determine it";
      else if (held)
        one.parameters = {row.gamma, {1.0, 0.0}, row.B, row.C};
      else
        one.parameters = {row.free_gamma, row.free_delta, row.free_B, row.free_C};
      out.push_back(std::move(one));
    }
  return out;
}

namespace {

/// A row and its style: colours distinguish labels, symbols distinguish smallest sizes.
struct Drawn {
  const NatureRow &row;
  int number;    ///< from 1 on
  bool nearest;  ///< the first of its label; of the others only the distance is drawn
  std::string style;
};

std::vector<Drawn> drawn_of(const std::vector<NatureRow> &rows) {
  constexpr std::array<int, 6> symbols = {7, 5, 9, 11, 13, 15};
  std::set<double> sizes;  // of the models
  for (const NatureRow &row : rows)
    if (!row.earthquakes) sizes.insert(row.threshold);
  std::map<std::string, std::size_t> labels;
  std::vector<Drawn> out;
  for (const NatureRow &row : rows) {
    const auto [label, nearest] = labels.emplace(row.label, labels.size());
    const auto size = std::distance(sizes.begin(), sizes.lower_bound(row.threshold));
    const int number = static_cast<int>(out.size()) + 1;
    std::string style = row.earthquakes
                            ? fmt::format("lc rgb '#000000' lw {} dt 1 pt {}", number == 1 ? 2 : 1,
                                          number == 1 ? 7 : 6)
                            : fmt::format("lt {} dt 1 pt {}", (label->second + 6) % 7 + 1,
                                          symbols[static_cast<std::size_t>(size) % symbols.size()]);
    out.push_back({row, number, nearest, std::move(style)});
  }
  return out;
}

void add_rows(Table &table, const Drawn &one) {
  const NatureRow &row = one.row;
  const auto add = [&](const char *panel, double x, double y, double error) {
    // gnuplot skips points with an empty error.
    table.row(panel, one.number, x, y, std::isnan(error) ? 0.0 : error, name_of(row));
  };
  if (one.number > 1) add("distance", row.distance.value, -1.0 * one.number, row.distance.error);
  if (!one.nearest) return;
  for (const LogBin &bin : time_densities(row)) add("times", bin.centre, bin.density, bin.error);
  double magnitude = 0.0;
  for (const double share : shares_above(row)) {
    add("sizes", magnitude, share, 0.0);
    magnitude += 0.1;
  }
  add("plane", row.memory.value, row.burstiness.value, row.burstiness.error);
}

/// Plot command of one panel, with the rows that are drawn in it.
std::string plot_of(const std::vector<Drawn> &rows, const std::string &panel, const char *values,
                    const char *style, const char *size) {
  std::string out;
  for (const Drawn &one : rows)
    if (panel == "distance" ? one.number > 1 : one.nearest)
      out += fmt::format("{}table using (at('{}', {})):{} with {} {} {}notitle",
                         out.empty() ? "plot " : ", \\\n     ", panel, one.number, values, style,
                         one.style, size);
  return out;
}

/// Entries of the key for the panels on the right.
std::string legend_of(const std::vector<Drawn> &rows) {
  std::string out;
  for (const Drawn &one : rows)
    if (one.nearest)
      out += fmt::format(", \\\n     keyentry with linespoints {} title {}", one.style,
                         quote(short_name_of(one.row)));
  return out + ", \\\n     keyentry with lines lt 8 dt (6,4) lw 2 title " +
         quote("earthquakes, Corral (2004)");
}

std::string ticks_of(const std::vector<Drawn> &rows) {
  std::string out;
  for (const Drawn &one : rows)
    if (one.number > 1)
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", quote(short_name_of(one.row)),
                         -one.number);
  return out;
}

}  // namespace

Figure nature_figure(const std::vector<NatureRow> &rows) {
  const std::vector<Drawn> drawn = drawn_of(rows);
  Table table("panel,curve,x,y,error,label");
  table.comment(
      "panels: distance (rank), and of the nearest row of each label times (density over time / "
      "mean), sizes (share of the events with magnitudes of at least x above the smallest), plane "
      "(burstiness, memory)");
  for (const Drawn &one : drawn) add_rows(table, one);
  const double free_end = std::nan("");
  const int height = std::max(900, 130 + 34 * static_cast<int>(rows.size()));
  // The key of the panels on the right is below them.
  const auto entries =
      1 + std::count_if(drawn.begin(), drawn.end(), [](const Drawn &one) { return one.nearest; });
  const double top = 0.97, legend = 26.0 * static_cast<double>(entries) / height + 0.01;
  const double high = (top - 0.09 - legend) / 0.77;
  std::string script =
      "at(p, k) = strcol(1) eq p && $2 == k ? $3 : NaN\nset multiplot\nset key off\n" +
      panel(0.36, 0.58, 0.1, 0.97) +
      axis("x", "distance of the inter-event times", false, 0.0, free_end) +
      axis("y", "", false, -static_cast<double>(rows.size()) - 0.7, -1.3) + "set ytics (" +
      ticks_of(drawn) + ")\nset xtics 0.2\n" +
      plot_of(drawn, "distance", "4:5", "xerrorbars", "ps 1.3 ") + "\n" +
      panel(0.68, 0.98, top - 0.17 * high, top) +
      axis("x", "inter-event time / mean", true, 1e-3, 30.0) +
      axis("y", "probability density", true, 1e-4, 1e2) +
      plot_of(drawn, "times", "4", "linespoints", "ps 0.7 ") +
      ", \\\n     [0.003:10] '+' using 1:(0.5*$1**(-0.33)*exp(-$1/1.58)) with lines lt 8 dt (6,4) "
      "lw 2 notitle\n" +
      panel(0.68, 0.98, top - 0.47 * high, top - 0.30 * high) +
      axis("x", "magnitude above the smallest", false, 0.0, 4.0) +
      axis("y", "share of the events", true, 1e-4, 1.0) +
      plot_of(drawn, "sizes", "4", "linespoints", "pi 3 ps 0.8 ") + "\n" +
      panel(0.68, 0.98, top - 0.77 * high, top - 0.60 * high) +
      axis("x", "memory coefficient", false, -0.3, 0.4) +
      axis("y", "burstiness (finite form)", false, -0.4, 1.0) +
      fmt::format("set key on at screen 0.99, screen {} right top Left reverse samplen 3\n",
                  legend) +
      plot_of(drawn, "plane", "4:5", "yerrorbars", "ps 1.4 ") + legend_of(drawn) +
      "\nunset multiplot\n";
  return {std::move(table), std::move(script), {1150, height}};
}

}  // namespace LSM::postproc
