// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"
#include "plot.h"
#include "size_densities.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  SizeDensitySettings densities;
  std::string range, normalise = "density";
  std::vector<std::string> guides;
};

void run(Options &options) {
  options.picture.check(options.catalogues.paths, {}, {options.json.output()});
  options.json.check(options.catalogues.paths);
  SizeDensitySettings &settings = options.densities;
  if (!options.range.empty()) {
    const Range range = parse_range("--range", options.range);
    if (range.lo > -std::numeric_limits<double>::infinity())
      settings.threshold = std::max(range.lo, settings.threshold.given_or_paper());
    settings.upto = range.hi;
  }
  settings.counts = options.normalise == "counts";
  for (const std::string &guide : options.guides) {
    settings.lines.push_back(parse_guide(guide));
    settings.lines.back().dash = 1 + static_cast<int>(settings.lines.size());
  }
  std::vector<std::string> empty;
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  const Figure figure = size_density_figure(tables, settings, empty);
  for (const std::string &line : texts(settings.threshold, tables)) fmt::print("{}\n", line);
  for (const std::string &label : empty)
    fmt::print(stderr, "postproc: {}: no event in the range of sizes, no curve\n", label);
  make(figure, options.picture);
  options.json.add("densities", figure.table);
  options.json.write();
}

}  // namespace

void add_histograms(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "histograms",
      "Densities of event sizes over logarithmic bins, count / (N width), with Poisson error bars, "
      "one curve per catalogue (paper: Figs. 7, 12, 13)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "histograms");
  SizeDensitySettings &densities = options->densities;
  const std::string group = "Densities";
  add_threshold(command, densities.threshold, "the densities")->group(group);
  command->add_option("--range", options->range, "LO:HI, only bins within this range of sizes")
      ->group(group);
  command
      ->add_option("--bin-factor", densities.factor,
                   "Ratio of the edges of a bin, c of the paper's c^n (the value is ours: ten bins "
                   "a decade)")
      ->group(group);
  command
      ->add_option("--normalise", options->normalise, "density: count / (N width); counts: per bin")
      ->check(CLI::IsMember({"density", "counts"}))
      ->group(group);
  command
      ->add_option("--guide", options->guides,
                   "SLOPE or SLOPE:LO:HI, a straight line above the points, e.g. -1.07 (paper, "
                   "fault) or -0.5:1e-3:1 (paper, small events of the block-slider)")
      ->type_name("LINE")
      ->default_str("")
      ->allow_extra_args(false)
      ->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
