// SPDX-License-Identifier: GPL-2.0-or-later
#include "nature_figure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "log_histogram.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

std::string cell(const Measured &one) {
  return std::isnan(one.value)   ? "-"
         : std::isnan(one.error) ? fmt::format("{:.2f}", one.value)
                                 : with_error(one.value, one.error, " ± ");
}

struct Column {
  const char *name, *title;
  Measured NatureRow::*member;
};

constexpr std::array<Column, 10> columns = {
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

/// The same in fewer words, for an axis.
std::string short_name_of(const NatureRow &row) {
  return row.label + (row.earthquakes ? ", M" : ",") + row.from.substr(row.from.find(' '));
}

}  // namespace

std::string nature_text(const std::vector<NatureRow> &rows) {
  std::string out = "| | catalogues, events |";
  for (const Column &column : columns) out += fmt::format(" {} |", column.title);
  out += "\n|---|---|";
  for (std::size_t i = 0; i < columns.size(); ++i) out += "---|";
  out += "\n";
  for (const NatureRow &row : rows) {
    out += fmt::format("| {} | {}, {} |", name_of(row), row.catalogues, row.n);
    for (const Column &column : columns) out += " " + cell(row.*column.member) + " |";
    out += "\n";
  }
  return out;
}

Table nature_csv(const std::vector<NatureRow> &rows) {
  std::vector<std::string> names = {"label", "threshold", "catalogues", "events"};
  for (const Column &column : columns) {
    names.emplace_back(column.name);
    names.push_back(std::string(column.name) + "_error");
  }
  Table table(names);
  table.comment(
      "distance: Kolmogorov-Smirnov distance of the inter-event times over their mean to those of "
      "the first row, size_distance: of the magnitudes above the smallest, over their mean");
  table.comment(
      "after_short: mean time after the shortest third over the mean; before, after: events "
      "within a mean time of large ones, over that of any others; b: Aki");
  table.comment(
      "errors: from the scatter between catalogues of a label, or for one catalogue its own "
      "(distances: blocks of consecutive values resampled)");
  for (const NatureRow &row : rows) {
    table.add(row.label).add(row.threshold).add(row.catalogues).add(row.n);
    for (const Column &column : columns)
      table.add((row.*column.member).value).add((row.*column.member).error);
    table.end_row();
  }
  return table;
}

std::vector<Table1Row> nature_table1(const std::vector<NatureRow> &rows,
                                     const std::string &plus_minus) {
  std::vector<Table1Row> out = table1({}, plus_minus);
  for (const NatureRow &row : rows)
    for (const bool held : {false, true}) {
      Table1Row one;
      one.source = row.label;
      one.from = row.from;
      one.method = fmt::format("maximum likelihood{}, {} catalogue{}", held ? ", δ = 1 held" : "",
                               row.catalogues, row.catalogues == 1 ? "" : "s");
      one.threshold = row.threshold;
      one.n = row.n;
      const std::array<Measured, 4> numbers =
          held ? std::array<Measured, 4>{row.gamma, {1.0, 0.0}, row.B, row.C}
               : std::array<Measured, 4>{row.free_gamma, row.free_delta, row.free_B, row.free_C};
      if (!held && row.without_delta > 0)
        one.why = row.catalogues == 1 ? row.why
                                      : fmt::format("in {} of {} catalogues: {}", row.without_delta,
                                                    row.catalogues, row.why);
      else if (std::isnan(row.gamma.value))
        one.why = "the times do not determine it";
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const Measured number = one.why.empty() ? numbers[i] : Measured();
        one.values[i] = number.value;
        one.errors[i] = number.error;
        if (one.why.empty()) one.parameters[i] = with_error(number.value, number.error, plus_minus);
      }
      out.push_back(std::move(one));
    }
  return out;
}

Figure nature_figure(const std::vector<NatureRow> &rows) {
  // All rows are ranked; what is drawn beside them is the nearest row of each label, as more curves
  // would hide each other. Colours tell labels, symbols smallest sizes.
  std::vector<std::string> labels;
  std::vector<double> sizes_of_models;
  std::vector<bool> nearest;
  for (const NatureRow &row : rows) {
    nearest.push_back(std::find(labels.begin(), labels.end(), row.label) == labels.end());
    if (nearest.back()) labels.push_back(row.label);
    if (!row.earthquakes) sizes_of_models.push_back(row.threshold);
  }
  std::sort(sizes_of_models.begin(), sizes_of_models.end());
  sizes_of_models.erase(std::unique(sizes_of_models.begin(), sizes_of_models.end()),
                        sizes_of_models.end());
  const int height = std::max(700, 130 + 34 * static_cast<int>(rows.size()));
  Figure figure{Table("panel,curve,x,y,error,label"), {}, {1150, height}};
  figure.table.comment(
      "panels: distance (rank), and of the nearest row of each label times (density over time / "
      "mean), sizes (share of the events with magnitudes of at least x above the smallest), plane "
      "(burstiness, memory)");
  const auto add = [&figure](const char *panel, std::size_t curve, double x, double y, double error,
                             const std::string &label) {
    // gnuplot skips points with an empty error
    figure.table.row(panel, curve, x, y, std::isnan(error) ? 0.0 : error, label);
  };
  std::string times, sizes, plane, distances, ticks;
  for (std::size_t k = 1; k <= rows.size(); ++k) {
    const NatureRow &row = rows[k - 1];
    const auto label = std::find(labels.begin(), labels.end(), row.label) - labels.begin();
    constexpr std::array<int, 6> symbols = {7, 5, 9, 11, 13, 15};
    const auto size =
        std::lower_bound(sizes_of_models.begin(), sizes_of_models.end(), row.threshold) -
        sizes_of_models.begin();
    const std::string colour =
        row.earthquakes
            ? fmt::format("lc rgb '#000000' lw {} dt 1 pt {}", k == 1 ? 2 : 1, k == 1 ? 7 : 6)
            : fmt::format("lt {} dt 1 pt {}", (label - 1) % 7 + 1,
                          symbols[static_cast<std::size_t>(size) % symbols.size()]);
    if (k > 1) {
      add("distance", k, row.distance.value, -1.0 * static_cast<double>(k), row.distance.error,
          name_of(row));
      distances +=
          fmt::format("{}table using (at('distance', {})):4:5 with xerrorbars {} ps 1.3 notitle",
                      k == 2 ? "plot " : ", \\\n     ", k, colour);
      ticks += fmt::format("{}{} {}", k == 2 ? "" : ", ", quote(short_name_of(row)),
                           -static_cast<int>(k));
    }
    if (!nearest[k - 1]) continue;
    LogHistogram histogram(std::pow(10.0, 0.2));
    for (const double time : row.times)
      if (time > 0.0) histogram.add(time);
    for (const LogBin &bin : histogram.bins())
      if (bin.count > 2) add("times", k, bin.centre, bin.density, bin.error, name_of(row));
    std::vector<double> sorted = row.magnitudes;
    std::sort(sorted.begin(), sorted.end());
    for (double m = 0.0; m <= sorted.back(); m += 0.1) {
      const auto above = static_cast<double>(
          sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), m - 1e-9));
      add("sizes", k, m, above / static_cast<double>(sorted.size()), 0.0, name_of(row));
    }
    add("plane", k, row.memory.value, row.burstiness.value, row.burstiness.error, name_of(row));
    const char *const start = k == 1 ? "plot " : ", \\\n     ";
    times += fmt::format("{}table using (at('times', {})):4 with linespoints {} ps 0.7 notitle",
                         start, k, colour);
    sizes +=
        fmt::format("{}table using (at('sizes', {})):4 with lines {} notitle", start, k, colour);
    plane += fmt::format("{}table using (at('plane', {})):4:5 with yerrorbars {} ps 1.4 notitle",
                         start, k, colour);
  }
  const auto panel = [](const char *margins) {
    return fmt::format(
        "unset logscale\nset format '%g'\nset xtics autofreq\nset ytics autofreq\n"
        "unset mxtics\nunset mytics\n{}\n",
        margins);
  };
  const double free_end = std::numeric_limits<double>::quiet_NaN();
  figure.script =
      "at(p, k) = strcol(1) eq p && $2 == k ? $3 : NaN\nset multiplot\nset key off\n" +
      panel(
          "set lmargin at screen 0.36; set rmargin at screen 0.58; set bmargin at screen 0.1; "
          "set tmargin at screen 0.97") +
      axis("x", "distance of the inter-event times", false, 0.0, free_end) +
      axis("y", "", false, -static_cast<double>(rows.size()) - 0.7, -1.3) + "set ytics (" + ticks +
      ")\nset xtics 0.1\n" + distances + "\n" +
      panel(
          "set lmargin at screen 0.68; set rmargin at screen 0.98; set bmargin at screen 0.77; "
          "set tmargin at screen 0.97") +
      axis("x", "inter-event time / mean", true, 1e-3, 30.0) +
      axis("y", "probability density", true, 1e-4, 1e2) + times +
      ", \\\n     [0.003:10] '+' using 1:(0.5*$1**(-0.33)*exp(-$1/1.58)) with lines lt 8 dt (6,4) "
      "lw "
      "2 notitle\n" +
      panel("set bmargin at screen 0.435; set tmargin at screen 0.635") +
      axis("x", "magnitude above the smallest", false, 0.0, 4.0) +
      axis("y", "share of the events", true, 1e-4, 1.0) + sizes + "\n" +
      panel("set bmargin at screen 0.1; set tmargin at screen 0.3") +
      axis("x", "memory coefficient", false, -0.3, 0.4) +
      axis("y", "burstiness (finite form)", false, -0.4, 1.0) + plane + "\nunset multiplot\n";
  return figure;
}

}  // namespace LSM::postproc
