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
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"
#include "plot.h"
#include "size_fit_tables.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  SizeFitSettings fits;
  std::vector<std::string> ranges;
  std::string search = "both";
  bool scaling = false, no_comparison = false;
  Resampling bootstrap;
  std::string block = "auto";
};

void run(Options &options) {
  options.picture.check(
      options.catalogues.paths,
      {".fits.csv", ".scaling.csv", ".scaling.gp", ".scaling.png", ".scaling.svg"},
      {options.json.output()});
  options.json.check(options.catalogues.paths);
  SizeFitSettings &settings = options.fits;
  for (const std::string &text : options.ranges) {
    const Range range = parse_range("--range", text);
    if (!(range.lo > 0.0))
      throw std::invalid_argument("--range '" + text + "', expected LO above 0");
    settings.ranges.push_back(range);
  }
  settings.search.upper = options.search == "both";
  settings.compare = !options.no_comparison;
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  const std::vector<SizeFit> fits = fit_sizes(tables, settings);
  std::vector<Scaling> scalings;
  if (options.scaling) {
    options.bootstrap.seed = settings.seed;
    options.bootstrap.block = parse_block(options.block);
    scalings = scale_sizes(tables, settings.threshold, options.bootstrap);
    if (scalings.empty())
      throw std::runtime_error("--scaling: no catalogue gives its length or number of blocks");
  }
  SizeDensitySettings densities;
  densities.threshold = settings.threshold;
  if (!settings.ranges.empty()) {
    double least = settings.threshold.given_or_paper();
    for (const Range &range : settings.ranges) least = std::min(least, range.lo);
    densities.threshold = least;
  }
  for (const SizeFit &fit : fits)
    if (!fit.fit.degenerate)
      densities.lines.push_back(fitted_line(fit, tables[fit.catalogue], densities));
  // Everything that can fail for want of events comes before the first file.
  std::vector<std::string> empty;
  const Figure sizes = size_density_figure(tables, densities, empty);

  if (settings.ranges.empty())
    for (const std::string &line : texts(settings.threshold, tables)) fmt::print("{}\n", line);
  fmt::print("{}", size_fits_text(fits));
  for (const Scaling &scaling : scalings) fmt::print("{}", scaling_text(scaling));
  nlohmann::json found = {{"fits", nlohmann::json::array()}};
  for (const SizeFit &fit : fits) found["fits"].push_back(to_json(fit));
  for (const Scaling &scaling : scalings) found["scaling"].push_back(to_json(scaling));
  for (const auto &[name, value] : found.items()) options.json.add(name, value);
  options.json.write();
  const std::string table = options.picture.output + ".fits.csv";
  size_fits_csv(fits).write(table);
  fmt::print("wrote {}\n", table);
  make(sizes, options.picture);
  if (std::any_of(scalings.begin(), scalings.end(), [](const auto &s) { return s.drawable(); })) {
    PictureOptions picture = options.picture;
    picture.output += ".scaling";
    make(scaling_figure(scalings), picture);
  } else if (options.scaling) {
    fmt::print(stderr,
               "postproc: no catalogue gives a characteristic size, no picture of the scaling\n");
  }
}

}  // namespace

void add_fit(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "fit",
      "Exponents of the event sizes by maximum likelihood, how well a power law fits, and, with "
      "--scaling, whether the roll-off moves with the length (ours; the paper fitted binned "
      "densities: 1.07 for the fault, 0.5 and 1.0 for the block-slider)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "fit");
  const std::string group = "Fit";
  command
      ->add_option(
          "--range", options->ranges,
          "LO:HI, sizes that are fitted, several allowed; without it the range is searched. LO is "
          "raised to where the catalogue begins (--min-size, or min_size in its header)")
      ->type_name("LO:HI")
      ->default_str("")
      ->allow_extra_args(false)
      ->group(group);
  command
      ->add_option(
          "--search", options->search,
          "Ends of the range that are searched by the smallest Kolmogorov-Smirnov distance: "
          "both, or lower (Clauset et al. 2009; the range then has no upper end)")
      ->check(CLI::IsMember({"both", "lower"}))
      ->group(group);
  add_threshold(command, options->fits.threshold, "the search, the picture and the scaling")
      ->group(group);
  command
      ->add_option("--replicas", options->fits.replicas,
                   "Synthetic samples of the Monte Carlo p-value; 0: none")
      ->check(zero_or_more())
      ->group(group);
  add_seed(command, options->fits.seed)->group(group);
  command->add_flag("--no-comparison", options->no_comparison, "Leave out the rival laws")
      ->group(group);
  command
      ->add_flag("--scaling", options->scaling,
                 "Characteristic size <s^2>/<s> against length for each model: a power law, no "
                 "dependence, or growth that ends at a length (ours)")
      ->group(group);
  command
      ->add_option("--bootstrap", options->bootstrap.replicas,
                   "Resampled catalogues for the errors of --scaling")
      ->check(CLI::Range(2, 1000000))
      ->group(group);
  command->add_option("--block", options->block, block_help)->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
