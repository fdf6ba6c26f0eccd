// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "lsm_text_io.h"
#include "magnitude_figure.h"
#include "magnitude_options.h"
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  MagnitudeOptions magnitudes;
  Threshold threshold;
  std::string complete = "header";
  double least_difference = std::numeric_limits<double>::quiet_NaN();
  double picture_bin = 0.1;
};

/// Magnitudes of one catalogue in order of its events.
std::vector<double> magnitudes_in(const EventTable &chosen, const Options &options) {
  struct Row {
    double start, magnitude;
  };
  std::vector<Row> rows;
  CatalogueOptions catalogue = options.catalogues;
  if (!chosen.region.empty()) catalogue.regions = {chosen.region};
  const EventTable table = read_events(chosen.path, catalogue, [&](const Event &event) {
    if (options.magnitudes.quantity(event) > 0.0)
      rows.push_back({event.t_start, options.magnitudes.magnitude(event)});
  });
  options.magnitudes.require(chosen.path, table.info);
  if (table.info.overlapping())
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row &a, const Row &b) { return a.start < b.start; });
  std::vector<double> out;
  for (const Row &row : rows) out.push_back(row.magnitude);
  return out;
}

/// Where the magnitudes of a curve are complete from.
void set_completeness(MagnitudeCurve &curve, const EventTable &table, const Options &options) {
  const MagnitudeOptions &m = options.magnitudes;
  if (text_io::parse(options.complete, curve.completeness)) {
    curve.completeness_text = "as given";
  } else if (options.complete == "curvature") {
    curve.completeness = curve.curvature;
    curve.completeness_text = "by maximum curvature";
  } else if (options.complete == "header" && m.of_moment) {
    throw std::invalid_argument(
        "--complete-from header holds for sizes only, expected 'curvature' or a magnitude with "
        "--magnitude-of moment");
  } else if (options.complete == "header") {
    const SmallestSize smallest = options.threshold.complete_in(table);
    if (!(smallest.size > 0.0))
      throw std::invalid_argument("--threshold 0 has no magnitude, expected a larger size");
    curve.completeness = m.scale.of(smallest.size);
    curve.completeness_text = "sizes >= " + text(smallest);
  } else {
    throw std::invalid_argument("--complete-from " + text_io::in_quotes(options.complete) +
                                ", expected 'header', 'curvature' or a magnitude");
  }
  // The first whole bin.
  if (m.bin > 0.0) curve.completeness = m.bin * std::ceil(curve.completeness / m.bin - 1e-9);
}

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  options.picture.check(options.catalogues.paths, {".bvalues.csv"}, {options.json.output()});
  options.magnitudes.check();
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  const double width = options.magnitudes.bin > 0.0 ? options.magnitudes.bin : options.picture_bin;
  std::vector<MagnitudeCurve> curves;
  for (const EventTable &table : tables) {
    MagnitudeCurve curve;
    curve.label = table.label;
    curve.model = table.info.model;
    curve.magnitudes = magnitudes_in(table, options);
    curve.curvature = maximum_curvature(curve.magnitudes, width);
    set_completeness(curve, table, options);
    curve.b = b_value(curve.magnitudes, curve.completeness, options.magnitudes.bin);
    curve.positive = b_positive(curve.magnitudes, curve.completeness, options.magnitudes.bin,
                                options.least_difference);
    curves.push_back(std::move(curve));
  }
  const Figure figure = magnitude_figure(curves, width);
  const std::string of = options.magnitudes.of();
  fmt::print("{}", magnitudes_text(curves, options.magnitudes.scale, of));
  const std::string table = options.picture.output + ".bvalues.csv";
  const Table values = magnitudes_csv(curves, options.magnitudes.scale, of, options.magnitudes.bin);
  values.write(table);
  fmt::print("wrote {}\n", table);
  make(figure, options.picture);
  options.json.add("b_values", values);
  options.json.add("frequencies", figure.table);
  options.json.write();
}

}  // namespace

void add_magnitudes(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "magnitudes",
      "Frequencies of magnitudes, b-value with its error (Aki 1965; in bins Tinti and Mulargia "
      "1987; error Shi and Bolt 1982), b-positive (van der Elst 2021) and completeness by maximum "
      "curvature. All ours: the paper has sizes only. Magnitudes are a convention, M = slope "
      "log10(size) + constant; a power law of sizes with exponent a gives b = (a - 1) / slope");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "magnitudes");
  const std::string group = "Magnitudes (ours)";
  options->magnitudes.add_to(command, group);
  command
      ->add_option("--complete-from", options->complete,
                   "Magnitude from which the catalogue is complete: header, that of --threshold; "
                   "curvature, centre of the fullest bin + 0.2 (Wiemer and Wyss 2000; Woessner and "
                   "Wiemer 2005); or a magnitude")
      ->group(group);
  add_threshold(command, options->threshold, "--complete-from header")->group(group);
  command
      ->add_option("--least-difference", options->least_difference,
                   "Smallest difference of magnitudes in b-positive")
      ->check(zero_or_more())
      ->default_str("width of the bins")
      ->group(group);
  command
      ->add_option("--picture-bin", options->picture_bin,
                   "Width of the bins of picture and maximum curvature, where --magnitude-bin is 0")
      ->check(CLI::PositiveNumber)
      ->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
