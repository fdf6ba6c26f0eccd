// SPDX-License-Identifier: GPL-2.0-or-later
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "nature_figure.h"
#include "option_values.h"
#include "picture_options.h"
#include "table1.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  PictureOptions picture;
  JsonOutput json;
  NatureSettings nature;
};

void run(Options &options) {
  options.picture.check(options.catalogues.paths, {".table.csv", ".table1.csv"},
                        {options.json.output()});
  options.json.check(options.catalogues.paths);
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  if (tables.size() < 2)
    throw std::invalid_argument("one catalogue, expected that of nature and at least one other");
  if (!tables.front().earthquakes())
    throw std::invalid_argument(tables.front().path +
                                ": catalogue of a model, expected one of earthquakes first");
  const std::vector<NatureRow> rows = nature_rows(tables, options.nature);
  fmt::print("{}", nature_text(rows));
  const std::string table = options.picture.output + ".table.csv";
  const Table numbers = nature_csv(rows);
  numbers.write(table);
  fmt::print("wrote {}\n", table);
  const std::vector<Table1Row> parameters = nature_table1(rows);
  fmt::print("{}", table1_text(parameters, true));
  const Table table1 = table1_csv(parameters, true);
  table1.write(options.picture.output + ".table1.csv");
  fmt::print("wrote {}.table1.csv\n", options.picture.output);
  make(nature_figure(rows), options.picture);
  options.json.add("models", numbers);
  options.json.add("table1", table1);
  options.json.write();
}

}  // namespace

void add_nature(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "nature",
      "Models beside nature: catalogues of models ranked by the distance of their inter-event "
      "times, over their mean, to those of earthquakes, with sizes, clustering and the events "
      "around large ones. The first catalogue is that of the earthquakes. Catalogues of the same "
      "--label are samples of one model, whose scatter gives the errors (ours)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "nature");
  NatureSettings &nature = options->nature;
  const std::string group = "Comparison (ours)";
  add_thresholds(command, nature.thresholds, "the models' events")->group(group);
  command
      ->add_option("--reference", nature.reference,
                   "Smallest size of the earthquakes, such as M2.5; several allowed, the least is "
                   "what models are compared with")
      ->allow_extra_args(false)
      ->transform(size_or_magnitude())
      ->check(zero_or_more())
      ->default_str("all that are there")
      ->group(group);
  command
      ->add_option("--shortest", nature.shortest,
                   "Shorter times, over their mean, are left out of the fits of gamma")
      ->check(zero_or_more())
      ->group(group);
  command->add_option("--main-share", nature.share, "Share of the events that count as large")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  command->add_option("--fewest", nature.fewest, "Catalogues with fewer events are left out")
      ->check(CLI::Range(20, 1000000000))
      ->group(group);
  command
      ->add_option("--replicas", nature.replicas,
                   "Resamplings of the errors of distances, in blocks of consecutive events")
      ->check(CLI::PositiveNumber)
      ->group(group);
  add_seed(command, nature.seed)->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
