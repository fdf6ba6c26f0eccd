// SPDX-License-Identifier: GPL-2.0-or-later
#include "clustering_tables.h"

#include <cmath>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

/// Each number of a clustering by its name in the table and in the text.
struct Named {
  const char *column, *text;
  AgainstChance number;
};

std::vector<Named> numbers_of(const Clustering &c) {
  return {{"variation", "variation (standard deviation / mean); independent", c.variation},
          {"finite_burstiness", "burstiness, finite form; independent", c.finite_burstiness},
          {"memory", "memory coefficient; shuffled", c.memory},
          {"after_short", "mean time after the shortest third / mean; shuffled", c.after[0]},
          {"after_middle", "after the middle third; shuffled", c.after[1]},
          {"after_long", "after the longest third; shuffled", c.after[2]},
          {"after_distance", "distance between times after short and long ones; shuffled",
           c.after_distance}};
}

}  // namespace

std::string clustering_text(const std::vector<IntervalCurve> &curves, const DateText &date) {
  std::string out;
  for (const IntervalCurve &curve : curves) {
    const Clustering &c = curve.clustering;
    if (std::isnan(c.burstiness)) continue;
    const auto time = [&](double t) { return curve.earthquakes ? date(t) : short_number(t, 6); };
    const Stretch &whole = curve.steadiness.whole;
    out += fmt::format("{}, {}\n", curve.label, curve.from());
    out += fmt::format(
        "  rate: {} events from {} to {}, {} per {}; the cumulative number departs from a straight "
        "line by {} of all{}\n",
        whole.n, time(whole.from), time(whole.to),
        short_number(static_cast<double>(whole.n) / (whole.to - whole.from), 3), curve.unit,
        short_number(whole.departure, 2),
        std::isnan(curve.steadiness.p)
            ? std::string()
            : fmt::format(", p = {} for a steady rate{}", short_number(curve.steadiness.p, 2),
                          curve.steadiness.p < 0.05 ? ": it is not steady" : ""));
    for (const Stretch &one : curve.steadiness.steady)
      out += fmt::format("    steady: {} to {}, {} events, departure {}\n", time(one.from),
                         time(one.to), one.n, short_number(one.departure, 2));
    out += fmt::format("  burstiness {}\n", short_number(c.burstiness, 3));
    for (const Named &one : numbers_of(c))
      out += fmt::format(
          "  {:<60} {:>8}; {} (p = {})\n", one.text, short_number(one.number.value, 3),
          with_error(one.number.mean, one.number.deviation), short_number(one.number.p, 2));
  }
  if (!out.empty())
    out +=
        "  γ of the fits is not the fraction of background events: it follows from the branching "
        "of sequences, and changes with rate and threshold (Saichev and Sornette 2007)\n";
  return out;
}

Table clustering_csv(const std::vector<IntervalCurve> &curves) {
  std::vector<std::string> columns = {"label", "threshold", "n",        "from",
                                      "to",    "departure", "steady_p", "burstiness"};
  for (const Named &one : numbers_of(Clustering()))
    for (const char *end : {"", "_random", "_random_deviation", "_p"})
      columns.push_back(std::string(one.column) + end);
  Table table(columns);
  table.comment(
      "departure: of the cumulative number of events from a straight line, over their number; "
      "steady_p: share of series of the same times, in blocks in random order, that depart as far");
  table.comment(
      "random: mean and standard deviation of independent exponential times (variation, "
      "burstiness) or of the times in random order; p: share of them as far from their mean");
  for (const IntervalCurve &curve : curves) {
    const Stretch &whole = curve.steadiness.whole;
    table.add(curve.label).add(curve.threshold.size).add(curve.n).add(whole.from).add(whole.to);
    table.add(whole.departure).add(curve.steadiness.p).add(curve.clustering.burstiness);
    for (const Named &one : numbers_of(curve.clustering))
      table.add(one.number.value).add(one.number.mean).add(one.number.deviation).add(one.number.p);
    table.end_row();
  }
  return table;
}

}  // namespace LSM::postproc
