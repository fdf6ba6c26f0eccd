// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "command.h"
#include "generalised_gamma.h"
#include "intervals.h"
#include "new_file.h"
#include "numbers.h"
#include "size_fits.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

/// The columns of one catalogue: name and text.
using Row = std::vector<std::pair<std::string, std::string>>;

void add(Row &row, std::string column, double value) {
  row.emplace_back(std::move(column), std::isnan(value) ? "" : short_number(value, 6));
}

double share(std::int64_t part, std::size_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : std::nan("");
}

/// Share of the times in [lo, hi). They are differences of times of steps, whose rounding is far
/// below a millionth of an end.
double share_within(const std::vector<double> &times, const Range &window) {
  const double lo = window.lo * (1.0 - 1e-6), hi = window.hi * (1.0 - 1e-6);
  return share(std::count_if(times.begin(), times.end(),
                             [lo, hi](double time) { return time >= lo && time < hi; }),
               times.size());
}

class Summary : public CatalogueAnalysis {
  std::vector<std::string> parameters_, ranges_, windows_;
  std::vector<std::pair<std::string, Range>> fitted_;  // name in the columns, sizes
  std::vector<double> thresholds_ = {1e-4, 1e-3, 1e-2, 1e-1};
  double brief_ = 3.0;
  std::optional<double> shortest_;
  std::string method_ = "likelihood", output_;

  const char *help() const override {
    return "One row of numbers for each catalogue: events, exponents, inter-event times above "
           "several sizes, as CSV † (for studies)";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    catalogues.add_magnitude_bin(command);
    OptionGroup group(command);
    group.add("--output,-o", output_, "File to write; without it standard output");
    group.add("--parameter", parameters_,
              "Parameter of the header that becomes a column, several allowed", shown(""));
    group.add("--range", ranges_,
              "LO:HI, sizes between which an exponent is fitted, several allowed; without it the "
              "three decades above the completeness, as postproc fit",
              kind("LO:HI"), shown(""));
    group.add("--threshold", thresholds_, "Smallest sizes of the events whose times are used",
              shown("1e-4 1e-3 1e-2 1e-1"), size_or_magnitude(), zero_or_more());
    group.add("--window", windows_,
              "LO:HI, fraction of the inter-event times in this window (model time), several "
              "allowed; shows oscillations of the blocks between the plates",
              kind("LO:HI"), shown(""));
    group.add("--brief", brief_, "Longest duration of a brief event (steps)", zero_or_more());
    group.add("--shortest", shortest_,
              "Leave times shorter than this multiple of their mean out of the fits; without it "
              "as postproc intervals",
              shown(""), zero_or_more());
    group.add("--method", method_,
              "How gamma, B and C are fitted: likelihood †, or least-squares on the density "
              "(as in the paper)",
              among({"likelihood", "least-squares"}));
  }

  std::vector<Output> outputs() const override { return {{"--output", output_}}; }

  void add_threshold(Row &row, const EventTable &table, double threshold) const {
    const std::string name = fmt::format("{}", threshold);
    std::vector<double> times = inter_event_times(table, threshold);
    add(row, "events_" + name, static_cast<double>(events_from(table, threshold)));
    const double mean = mean_of(times);
    add(row, "mean_time_" + name, mean);
    for (const std::string &window : windows_)
      add(row, "share_" + window + "_" + name,
          share_within(times, parse_range("--window", window)));
    const RankCorrelation successive = successive_rank_correlation(times);
    times = positive_ones(std::move(times));
    const FitMethod method =
        method_ == "likelihood" ? FitMethod::maximum_likelihood : FitMethod::least_squares;
    const GeneralisedGammaFit fit =
        fit_times(method, times, log_histogram(times), shortest_, table.picker_memory(), mean, 1.0);
    add(row, "shortest_" + name, fit.lo);
    add(row, "gamma_" + name, fit.gamma);
    add(row, "gamma_error_" + name, fit.se_gamma);
    add(row, "B_" + name, fit.B);
    add(row, "C_" + name, fit.C);
    add(row, "spearman_" + name, successive.rho);
    add(row, "spearman_p_" + name, successive.p);
  }

  /// Share of brief events, of at most so many steps, among those of the smallest threshold.
  double share_of_brief(const EventTable &table) const {
    const double least = *std::min_element(thresholds_.begin(), thresholds_.end());
    const std::string *const text = table.info.find("dt");
    double dt = 0.0;
    if (!text || !text::parse(*text, dt)) return std::nan("");
    std::int64_t brief = 0;
    for (const EventSummary &event : table.events)
      brief += event.size >= least && event.t_end - event.t_start <= (brief_ + 0.5) * dt;
    return share(brief, static_cast<std::size_t>(events_from(table, least)));
  }

  Row row_of(const EventTable &table) const {
    Row row = {{"label", table.label}};
    for (const std::string &name : parameters_) {
      const std::string *const value = table.info.find(name);
      row.emplace_back(name, value ? *value : "");
    }
    std::vector<double> sorted = column(table.events, &Event::size);
    std::sort(sorted.begin(), sorted.end());
    add(row, "events", static_cast<double>(sorted.size()));
    add(row, "time", sorted.empty() ? 0.0 : table.last_end - table.events.front().t_start);
    add(row, "largest", sorted.empty() ? std::nan("") : sorted.back());
    add(row, "released", sum_pairwise(sorted.data(), sorted.size()));
    add(row, "in_events", table.share_in_events());
    add(row, "brief", share_of_brief(table));
    for (const auto &[text, range] : fitted_) {
      const PowerLawFit fit = fit_power_law(sorted, range.lo, range.hi, table.size_step());
      add(row, "exponent_" + text, fit.alpha);
      add(row, "error_" + text, fit.standard_error);
      add(row, "ks_" + text, fit.ks);
    }
    for (const double threshold : thresholds_) add_threshold(row, table, threshold);
    return row;
  }

  Results find() override {
    const std::vector<EventTable> tables = load_catalogues(catalogues);
    expect_events(tables);
    for (const std::string &text : ranges_)
      fitted_.emplace_back(text, parse_range("--range", text));
    if (ranges_.empty()) {
      double smallest = 0.0;  // a single range, as all rows have the same columns
      for (const EventTable &table : tables)
        smallest = std::max(smallest, Threshold().of(table).size);
      const Range range = paper_range(smallest);
      fitted_.emplace_back(fmt::format("{:g}:{:g}", range.lo, range.hi), range);
    }
    std::vector<Row> rows;
    for (const EventTable &table : tables) rows.push_back(row_of(table));
    std::vector<std::string> columns;
    for (const auto &[column, value] : rows.front()) columns.push_back(column);
    Table out(columns);
    out.comment(
        "sizes in energy units, times from start to start; exponent_LO:HI: power law on [LO, HI] by "
        "maximum likelihood; gamma, B and C (delta = 1) by " +
        method_ + " of the times of at least 'shortest', of events of the size in the name");
    out.comment("brief: share of the events that last " + short_number(brief_) +
                " steps or less; spearman: rank correlation of successive times, with its p");
    for (const Row &row : rows) {
      for (const auto &[column, value] : row) out.add(value);
      out.end_row();
    }
    Results results;
    for (const std::string &note : bin_notes(tables)) results.warn(note);
    if (output_.empty()) {
      results.say(out.csv());
    } else {
      check_replaced(output_, overwrite, [&](std::string_view head) { return out.like(head); });
      out.write(output_);
      results.say("wrote " + output_ + "\n");
    }
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_summary() { return std::make_shared<Summary>(); }

}  // namespace LSM::postproc
