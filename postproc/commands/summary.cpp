// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "generalised_gamma.h"
#include "intervals.h"
#include "log_histogram.h"
#include "lsm_sum.h"
#include "lsm_text_io.h"
#include "new_file.h"
#include "numbers.h"
#include "option_values.h"
#include "plot.h"
#include "power_law.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  std::vector<std::string> parameters, ranges, windows;
  std::vector<double> thresholds = {1e-4, 1e-3, 1e-2, 1e-1};
  double brief = 3.0;
  double shortest = 0.0;
  std::string method = "likelihood", output;
};

/// A column and what stands there for a catalogue.
using Row = std::vector<std::pair<std::string, std::string>>;

void add(Row &row, std::string column, double value) {
  row.emplace_back(std::move(column), std::isnan(value) ? "" : short_number(value, 6));
}

void add_range(Row &row, const std::string &text, const Range &range,
               const std::vector<double> &sorted) {
  const PowerLawFit fit = fit_power_law(sorted, range.lo, range.hi);
  add(row, "exponent_" + text, fit.alpha);
  add(row, "error_" + text, fit.standard_error);
  add(row, "ks_" + text, fit.ks);
}

double share_within(const std::vector<double> &times, const Range &window) {
  const auto inside = std::count_if(times.begin(), times.end(), [&window](double time) {
    return time >= window.lo && time < window.hi;
  });
  return times.empty() ? std::nan("")
                       : static_cast<double>(inside) / static_cast<double>(times.size());
}

GeneralisedGammaFit fit_times(const std::vector<double> &times, const Options &options) {
  GeneralisedGammaOptions fixed;
  fixed.fix_delta = 1.0;
  const double shortest = times.empty() || options.shortest == 0.0
                              ? 0.0
                              : options.shortest * sum_pairwise(times.data(), times.size()) /
                                    static_cast<double>(times.size());
  if (options.method == "likelihood") return fit_with_share(times, shortest, fixed);
  LogHistogram histogram;
  for (const double time : times) histogram.add(time);
  std::vector<LogBin> fitted;
  for (const LogBin &bin : histogram.bins())
    if (bin.lo >= shortest) fitted.push_back(bin);
  return fit_least_squares(fitted, fixed);
}

void add_threshold(Row &row, const EventTable &table, double threshold, const Options &options) {
  const std::string name = fmt::format("{}", threshold);
  std::vector<double> times = inter_event_times(table, threshold);
  add(row, "events_" + name,
      static_cast<double>(std::count_if(table.size.begin(), table.size.end(),
                                        [threshold](double size) { return size >= threshold; })));
  add(row, "mean_time_" + name,
      times.empty() ? std::nan("")
                    : sum_pairwise(times.data(), times.size()) / static_cast<double>(times.size()));
  for (const std::string &window : options.windows)
    add(row, "share_" + window + "_" + name, share_within(times, parse_range("--window", window)));
  const RankCorrelation successive = successive_rank_correlation(times);
  // Events of zero length can start at the same time.
  times.erase(std::remove_if(times.begin(), times.end(), [](double time) { return !(time > 0.0); }),
              times.end());
  const GeneralisedGammaFit fit = fit_times(times, options);
  add(row, "gamma_" + name, fit.gamma);
  add(row, "gamma_error_" + name, fit.se_gamma);
  add(row, "B_" + name, fit.B);
  add(row, "C_" + name, fit.C);
  add(row, "spearman_" + name, successive.rho);
  add(row, "spearman_p_" + name, successive.p);
}

/// Share of the events of the smallest threshold that last so few steps.
double share_of_brief(const EventTable &table, const Options &options) {
  const double least = *std::min_element(options.thresholds.begin(), options.thresholds.end());
  const std::string *const text = table.info.find("dt");
  double dt = 0.0;
  if (!text || !text_io::parse(*text, dt)) return std::nan("");
  std::int64_t all = 0, brief = 0;
  for (std::size_t i = 0; i < table.size.size(); ++i) {
    if (!(table.size[i] >= least)) continue;
    ++all;
    if (table.t_end[i] - table.t_start[i] <= (options.brief + 0.5) * dt) ++brief;
  }
  return all > 0 ? static_cast<double>(brief) / static_cast<double>(all) : std::nan("");
}

Row summarise(const EventTable &table, const Options &options) {
  Row row = {{"label", table.label}};
  for (const std::string &name : options.parameters) {
    const std::string *const value = table.info.find(name);
    row.emplace_back(name, value ? *value : "");
  }
  add(row, "events", static_cast<double>(table.size.size()));
  add(row, "time", table.t_start.empty() ? 0.0 : table.last_end - table.t_start.front());
  std::vector<double> sorted = table.size;
  std::sort(sorted.begin(), sorted.end());
  add(row, "largest", sorted.empty() ? std::nan("") : sorted.back());
  add(row, "released", sum_pairwise(sorted.data(), sorted.size()));
  add(row, "in_events", table.share_in_events());
  add(row, "brief", share_of_brief(table, options));
  for (const std::string &text : options.ranges)
    add_range(row, text, parse_range("--range", text), sorted);
  for (const double threshold : options.thresholds) add_threshold(row, table, threshold, options);
  return row;
}

void run(Options &options) {
  if (options.ranges.empty()) options.ranges = {"1e-4:1e-1", "1e-3:1"};
  if (!options.output.empty()) refuse_input(options.output, options.catalogues.paths);
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  std::vector<Row> rows;
  for (const EventTable &table : tables) rows.push_back(summarise(table, options));
  std::vector<std::string> columns;
  for (const auto &[column, value] : rows.front()) columns.push_back(column);
  Table out(columns);
  out.comment("sizes in energy units, times from start to start; exponents by maximum likelihood,");
  out.comment("gamma, B and C (delta = 1) by " + options.method +
              "; brief: share of the events that last " + short_number(options.brief) +
              " steps or less; spearman: rank correlation of successive times, with its p");
  for (const Row &row : rows) {
    for (const auto &[column, value] : row) out.add(value);
    out.end_row();
  }
  if (options.output.empty())
    fmt::print("{}", out.text());
  else {
    out.write(options.output);
    fmt::print("wrote {}\n", options.output);
  }
}

}  // namespace

void add_summary(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "summary",
      "One row of numbers for each catalogue: events, exponents, inter-event times above several "
      "sizes, as CSV (ours; for studies)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  command->add_option("--output,-o", options->output, "File to write; without it standard output");
  command
      ->add_option("--parameter", options->parameters,
                   "Value of the header that becomes a column, several allowed")
      ->default_str("");
  command
      ->add_option("--range", options->ranges,
                   "LO:HI, sizes between which an exponent is fitted, several allowed")
      ->type_name("LO:HI")
      ->default_str("1e-4:1e-1 1e-3:1");
  command
      ->add_option("--threshold", options->thresholds,
                   "Smallest sizes of the events whose times are used")
      ->default_str("1e-4 1e-3 1e-2 1e-1")
      ->check(zero_or_more());
  command
      ->add_option("--window", options->windows,
                   "LO:HI, share of the inter-event times within (model time), several allowed: "
                   "swings of the blocks between the plates stand out so")
      ->type_name("LO:HI")
      ->default_str("");
  command
      ->add_option("--brief", options->brief, "Steps that an event lasts at most to count as brief")
      ->check(zero_or_more());
  command
      ->add_option(
          "--shortest", options->shortest,
          "Leave times shorter than this multiple of their mean out of the fits; gamma <= 0 "
          "needs more than 0")
      ->check(zero_or_more());
  command
      ->add_option("--method", options->method,
                   "How gamma, B and C are fitted: likelihood (ours), or least-squares on the "
                   "density (as in the paper)")
      ->check(CLI::IsMember({"likelihood", "least-squares"}));
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
