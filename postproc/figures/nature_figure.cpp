// SPDX-License-Identifier: GPL-2.0-or-later
#include "nature_figure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "clustering.h"
#include "generalised_gamma.h"
#include "intervals.h"
#include "log_histogram.h"
#include "lsm_sum.h"
#include "magnitudes.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// One catalogue above one smallest size.
struct Sample {
  std::vector<double> times, magnitudes;
  std::vector<std::pair<Measured NatureRow::*, Measured>> numbers;  // the same of all samples
  std::string why;                                                  // delta cannot be fitted
};

std::vector<double> rescaled(std::vector<double> times) {
  const double mean = sum_pairwise(times.data(), times.size()) / static_cast<double>(times.size());
  for (double &time : times) time /= mean;
  return times;
}

Sample sample_of(const EventTable &table, double threshold, const Sample *reference,
                 const NatureSettings &settings) {
  Sample out;
  std::vector<double> sizes;
  const MagnitudeScale scale;
  for (const double size : table.size)
    if (size >= threshold) {
      sizes.push_back(size);
      out.magnitudes.push_back(scale.of(size) - scale.of(threshold));
    }
  out.times = rescaled(inter_event_times(table, threshold));
  const Clustering c = clustering(out.times, 1, settings.seed);
  out.numbers.push_back({&NatureRow::variation, {c.variation.value}});
  out.numbers.push_back({&NatureRow::burstiness, {c.finite_burstiness.value}});
  out.numbers.push_back({&NatureRow::memory, {c.memory.value}});
  out.numbers.push_back({&NatureRow::after_short, {c.after[0].value}});
  const BValue b = b_value(out.magnitudes, 0.0);
  out.numbers.push_back({&NatureRow::b, {b.b, b.error}});
  // Events of zero length can start at the same time.
  std::vector<double> positive = out.times;
  positive.erase(
      std::remove_if(positive.begin(), positive.end(), [](double t) { return !(t > 0); }),
      positive.end());
  GeneralisedGammaOptions held;
  held.fix_delta = 1.0;
  const GeneralisedGammaFit fit = fit_with_share(positive, settings.shortest, held);
  out.numbers.push_back({&NatureRow::gamma, {fit.gamma, fit.se_gamma}});
  out.numbers.push_back({&NatureRow::B, {fit.B, fit.se_B}});
  out.numbers.push_back({&NatureRow::C, {fit.C, fit.se_C}});
  const GeneralisedGammaFit free = fit_with_share(positive, settings.shortest, {});
  out.numbers.push_back({&NatureRow::free_gamma, {free.gamma, free.se_gamma}});
  out.numbers.push_back({&NatureRow::free_delta, {free.delta, free.se_delta}});
  out.numbers.push_back({&NatureRow::free_B, {free.B, free.se_B}});
  out.numbers.push_back({&NatureRow::free_C, {free.C, free.se_C}});
  if (free.degenerate) out.why = free.why;
  const AroundLarge around = around_large(starts_of(table, threshold), sizes, settings.share);
  out.numbers.push_back({&NatureRow::before, {around.before}});
  out.numbers.push_back({&NatureRow::after, {around.after}});
  if (!reference) return out;
  const RescaledDistance times =
      rescaled_distance(reference->times, out.times, settings.replicas, settings.seed);
  out.numbers.push_back({&NatureRow::distance, {times.distance, times.error}});
  const RescaledDistance magnitudes =
      rescaled_distance(reference->magnitudes, out.magnitudes, settings.replicas, settings.seed);
  out.numbers.push_back({&NatureRow::size_distance, {magnitudes.distance, magnitudes.error}});
  return out;
}

/// Mean and its error: from the scatter of two and more, and not below that of their own errors.
Measured mean_of(std::vector<Measured> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](const Measured &one) { return std::isnan(one.value); }),
               values.end());
  if (values.empty()) return {};
  if (values.size() == 1) return values.front();
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0, own = 0.0;
  for (const Measured &one : values) sum += one.value;
  for (const Measured &one : values) {
    squares += (one.value - sum / n) * (one.value - sum / n);
    if (one.error > 0.0) own += one.error * one.error;
  }
  return {sum / n, std::sqrt(std::max(squares / (n - 1.0) / n, own / n / n))};
}

NatureRow row_of(const std::vector<Sample> &samples) {
  NatureRow row;
  row.catalogues = static_cast<std::int64_t>(samples.size());
  std::vector<std::vector<Measured>> numbers(samples.front().numbers.size());
  for (const Sample &sample : samples) {
    row.n += static_cast<std::int64_t>(sample.magnitudes.size());
    row.times.insert(row.times.end(), sample.times.begin(), sample.times.end());
    row.magnitudes.insert(row.magnitudes.end(), sample.magnitudes.begin(), sample.magnitudes.end());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].push_back(sample.numbers[i].second);
    if (!sample.why.empty()) {
      ++row.without_delta;
      row.why = sample.why;
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    row.*(samples.front().numbers[i].first) = mean_of(numbers[i]);
  return row;
}

std::int64_t events_from(const EventTable &table, double threshold) {
  return std::count_if(table.size.begin(), table.size.end(),
                       [threshold](double size) { return size >= threshold; });
}

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

std::vector<NatureRow> nature_rows(const std::vector<EventTable> &tables,
                                   const NatureSettings &settings) {
  std::vector<std::vector<const EventTable *>> groups;
  for (const EventTable &table : tables) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&table](const auto &group) {
      return group.front()->label == table.label;
    });
    if (same == groups.end())
      groups.push_back({&table});
    else
      same->push_back(&table);
  }
  Sample reference;
  std::vector<NatureRow> rows;
  for (const auto &group : groups) {
    const EventTable &first = *group.front();
    std::vector<double> given = first.earthquakes() ? settings.reference : settings.thresholds;
    std::sort(given.begin(), given.end());
    std::vector<Threshold> thresholds(given.begin(), given.end());
    if (thresholds.empty()) thresholds.emplace_back();
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
      const double least = thresholds[i].complete_in(first).size;
      // Where the catalogue begins above a smallest size, the next one says the same.
      if (i + 1 < thresholds.size() &&
          events_from(first, least) ==
              events_from(first, thresholds[i + 1].complete_in(first).size))
        continue;
      std::vector<Sample> samples;
      for (const EventTable *table : group)
        if (events_from(*table, least) >= settings.fewest)
          samples.push_back(
              sample_of(*table, least, reference.times.empty() ? nullptr : &reference, settings));
      if (samples.empty() && rows.empty())
        throw std::runtime_error(
            fmt::format("{}: fewer than {} events to compare with", first.path, settings.fewest));
      if (samples.empty()) continue;
      if (rows.empty()) reference = samples.front();
      NatureRow row = row_of(samples);
      row.label = first.label;
      row.earthquakes = first.earthquakes();
      row.threshold = least;
      IntervalCurve words;
      words.earthquakes = row.earthquakes;
      words.threshold.size = least;
      row.from = words.from();
      rows.push_back(std::move(row));
    }
  }
  std::stable_sort(rows.begin() + 1, rows.end(), [](const NatureRow &a, const NatureRow &b) {
    return a.distance.value < b.distance.value;
  });
  return rows;
}

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
      "after_short: mean time after the shortest third over the mean; before, after: events within "
      "a mean time of large ones, 1 if these were like any others; b: Aki");
  table.comment(
      "errors: from the scatter between catalogues of a label, or of one catalogue its own "
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
  Figure figure{Table({"panel", "curve", "x", "y", "error", "label"}), {}, {1150, height}};
  figure.table.comment(
      "panels: distance (rank), and of the nearest row of each label times (density over time / "
      "mean), sizes (share of the events with magnitudes of at least x above the smallest), plane "
      "(burstiness, memory)");
  const auto add = [&figure](const char *panel, std::size_t curve, double x, double y, double error,
                             const std::string &label) {
    // gnuplot passes over points with an empty error
    figure.table.add(panel).add(static_cast<std::int64_t>(curve)).add(x).add(y);
    figure.table.add(std::isnan(error) ? 0.0 : error);
    figure.table.add(label).end_row();
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
