// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "interval_figures.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

class Intervals : public Statistic {
  IntervalSettings settings_;
  std::string method_ = "both";
  std::vector<std::string> deltas_ = {"1", "free"};

  const char *help() const override {
    return "Densities of inter-event times (start to start), generalised gamma fits "
           "(paper: Figs. 14, 15, Table 1)";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "intervals");
    OptionGroup group(command, "Inter-event times");
    add_thresholds(group, settings_.thresholds);
    group.flag("--rescale", settings_.rescale,
               "Divide the times of each curve by their mean (as Corral 2004 does)");
    group.add("--method", method_,
              "Fit by least-squares on the density (as in the paper), likelihood †, or both",
              among({"least-squares", "likelihood", "both"}));
    group.add("--delta", deltas_, "Exponent in the exponential: free or a value, several allowed",
              one_each());
    group.add("--shortest", settings_.shortest,
              "Leave times shorter than this multiple of their mean out of the fits; without it "
              "likelihood leaves out those below 2.5 memories of the picker and below 0.05 of the "
              "mean †, and least-squares none (as in the paper). By likelihood gamma <= 0 needs a "
              "value above 0",
              shown(""), zero_or_more());
    group.add("--replicas", settings_.replicas,
              "Synthetic samples of the Monte Carlo p-value of each fit by likelihood; 0: none",
              zero_or_more());
    settings_.shuffles = -1;
    group.add(
        "--shuffles", settings_.shuffles,
        "Random series with which burstiness, memory and the steadiness of the rate are compared; "
        "0: none. With more than 1e5 times the default is fewer",
        shown("200"), zero_or_more());
    add_seed(group, settings_.seed);
  }

  std::vector<std::string> endings() const override { return {".fits.csv", ".clustering.csv"}; }

  static Table times_of(const std::vector<IntervalCurve> &curves) {
    TableOf<IntervalCurve> table;
    table.column("label", "catalogue", [](auto &curve) { return curve.label; });
    table.show("events", source_of);
    table.data("threshold", [](auto &curve) { return curve.threshold.size; });
    table.column("n", "inter-event times", &IntervalCurve::n);
    table.column("mean", "mean", &IntervalCurve::mean, 6);
    table.show("in", [](auto &curve) { return curve.unit; });
    table.column("variation", "standard deviation / mean", &IntervalCurve::variation);
    for (const IntervalCurve &curve : curves) table.row(curve);
    return Table(std::move(table));
  }

  Results of(const std::vector<EventTable> &tables) override {
    settings_.least_squares = method_ != "likelihood";
    settings_.maximum_likelihood = method_ != "least-squares";
    settings_.deltas.clear();
    for (const std::string &text : deltas_) {
      double delta = std::numeric_limits<double>::quiet_NaN();
      if (text != "free" && !(text::parse(text, delta) && delta > 0.0))
        throw std::invalid_argument("--delta " + text::in_quotes(text) +
                                    ", expected 'free' or a positive number");
      settings_.deltas.push_back(delta);
    }
    expect_events(tables);
    const std::vector<IntervalCurve> curves = interval_curves(tables, settings_);
    Figure figure = interval_figure(curves, settings_.rescale);
    Results results;
    for (const IntervalCurve &curve : curves)
      if (curve.bins.empty())
        results.warn(
            curve.n > 0
                ? curve.label + ": all times are 0: the events start together"
                : fmt::format("{}: fewer than two events of size {} or larger, no inter-event time",
                              curve.label, short_number(curve.threshold.size)));
      else if (curve.zeros > 0)
        results.warn(fmt::format("{}, {}: {} of {} times are 0, left out of densities and fits",
                                 curve.label, curve.from(), curve.zeros, curve.n));
    results.table("fits", interval_fit_table(curves, settings_.rescale), ".fits");
    results.table("times", times_of(curves));
    results.table("clustering", clustering_table(curves), ".clustering");
    results.figure("densities", std::move(figure));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_intervals() { return std::make_shared<Intervals>(); }

}  // namespace LSM::postproc
