// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "clustering_figures.h"
#include "clustering_tables.h"
#include "commands.h"
#include "interval_figure.h"
#include "json_output.h"
#include "lsm_text_io.h"
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"
#include "plot.h"
#include "table1.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  IntervalSettings intervals;
  std::string method = "both";
  std::vector<std::string> deltas = {"free", "1"};
};

void run(Options &options) {
  std::vector<std::string> outputs = {".table1.csv", ".clustering.csv"};
  for (const char *const name : {".rate", ".conditional"})
    for (const char *const kind : {".csv", ".gp", ".png", ".svg"})
      outputs.push_back(std::string(name) + kind);
  options.picture.check(options.catalogues.paths, outputs, {options.json.output()});
  options.json.check(options.catalogues.paths);
  IntervalSettings &settings = options.intervals;
  settings.least_squares = options.method != "likelihood";
  settings.maximum_likelihood = options.method != "least-squares";
  settings.deltas.clear();
  for (const std::string &text : options.deltas) {
    double delta = std::numeric_limits<double>::quiet_NaN();
    if (text != "free" && !(text_io::parse(text, delta) && delta > 0.0))
      throw std::invalid_argument("--delta " + text_io::in_quotes(text) +
                                  ", expected 'free' or a positive number");
    settings.deltas.push_back(delta);
  }
  const std::vector<IntervalCurve> curves =
      interval_curves(load_catalogues(options.catalogues), settings);
  const Figure figure = interval_figure(curves, settings.rescale);
  for (const IntervalCurve &curve : curves)
    if (curve.bins.empty())
      fmt::print(stderr,
                 "postproc: {}: fewer than two events of size {} or larger, no inter-event time\n",
                 curve.label, short_number(curve.threshold.size));
  const std::vector<Table1Row> rows = table1(curves);
  Table times({"label", "threshold", "n", "mean", "variation"});
  for (const IntervalCurve &curve : curves)
    times.add(curve.label)
        .add(curve.threshold.size)
        .add(curve.n)
        .add(curve.mean)
        .add(curve.variation)
        .end_row();
  for (const IntervalCurve &curve : curves)
    if (curve.n > 0)
      fmt::print(
          "{}, {}: {} inter-event times, mean {} {}, standard deviation {} of the mean, burstiness "
          "{}\n",
          curve.label, curve.earthquakes ? curve.from() : "sizes >= " + text(curve.threshold),
          curve.n, short_number(curve.mean, 6), curve.unit, short_number(curve.variation),
          short_number(curve.burstiness()));
  if (settings.places > 0)
    fmt::print(
        "times at {} places each; places closer than ruptures are long share ruptures, and then "
        "errors and p are too small\n",
        settings.places);
  fmt::print("{}", table1_text(rows, settings.rescale));
  if (settings.shortest > 0.0)
    fmt::print("  fits without times below {} of the mean (--shortest)\n",
               short_number(settings.shortest));
  table1_csv(rows, settings.rescale).write(options.picture.output + ".table1.csv");
  fmt::print("wrote {}.table1.csv\n", options.picture.output);
  fmt::print("{}", clustering_text(curves, date_text));
  const Table clusters = clustering_csv(curves);
  clusters.write(options.picture.output + ".clustering.csv");
  fmt::print("wrote {}.clustering.csv\n", options.picture.output);
  make(figure, options.picture);
  const bool clustered = std::any_of(curves.begin(), curves.end(), has_clustering);
  if (clustered) {
    const Figure rate = rate_figure(curves), conditional = conditional_figure(curves);
    make(rate, named(options.picture, ".rate"));
    make(conditional, named(options.picture, ".conditional"));
    options.json.add("rate", rate.table);
    options.json.add("conditional", conditional.table);
  }
  std::vector<Table1Row> ours;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(ours),
               [](const Table1Row &row) { return !row.printed; });
  options.json.add("times", times);
  options.json.add("fits", table1_csv(ours, settings.rescale));
  options.json.add("densities", figure.table);
  options.json.add("clustering", clusters);
  options.json.write();
}

}  // namespace

void add_intervals(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "intervals",
      "Densities of inter-event times (start to start), generalised gamma fits, and the parameters "
      "beside the paper's Table 1 (paper: Figs. 14, 15)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "intervals");
  IntervalSettings &intervals = options->intervals;
  const std::string group = "Inter-event times";
  add_thresholds(command, intervals.thresholds, "the events")->group(group);
  command
      ->add_option("--places", intervals.places,
                   "Times between ruptures that reach the same place, for this number of places "
                   "along the fault, all together (ours; catalogues of ruptures of faults); 0: "
                   "between any two events")
      ->check(zero_or_more())
      ->group(group);
  command
      ->add_flag("--rescale", intervals.rescale,
                 "Divide the times of each curve by their mean (as Corral 2004 does)")
      ->group(group);
  command
      ->add_option("--bin-factor", intervals.factor,
                   "Ratio of the edges of a bin (the value is ours: ten bins a decade)")
      ->group(group);
  command
      ->add_option("--method", options->method,
                   "How to fit: least-squares on the density (as in the paper), likelihood (ours), "
                   "or both")
      ->check(CLI::IsMember({"least-squares", "likelihood", "both"}))
      ->group(group);
  command
      ->add_option("--delta", options->deltas,
                   "Exponent in the exponential: free or a value, several allowed")
      ->allow_extra_args(false)
      ->group(group);
  command
      ->add_option("--shortest", intervals.shortest,
                   "Leave times shorter than this multiple of their mean out of the fits, as those "
                   "within sequences (ours); 0: none, as in the paper. By likelihood gamma <= 0 "
                   "needs more than 0")
      ->check(zero_or_more())
      ->group(group);
  command
      ->add_option("--replicas", intervals.replicas,
                   "Synthetic samples of the Monte Carlo p-value of each fit by likelihood, fitted "
                   "as the data were; 0: none")
      ->check(zero_or_more())
      ->group(group);
  intervals.shuffles = -1;
  command
      ->add_option(
          "--shuffles", intervals.shuffles,
          "Random series that burstiness, memory, times after short and long ones, and the "
          "steadiness of the rate are compared with (of more than 1e5 times 2e7 times in all, at "
          "least 19 series, unless a number is given); 0: without these")
      ->default_str("200")
      ->check(zero_or_more())
      ->group(group);
  command
      ->add_option(
          "--steady", intervals.steady,
          "Largest departure of the cumulative number of events from a straight line, over "
          "their number, of stretches proposed as steady (ours)")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  command->add_option("--steady-events", intervals.steady_events, "Fewest events of such a stretch")
      ->check(CLI::PositiveNumber)
      ->group(group);
  add_seed(command, intervals.seed)->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
