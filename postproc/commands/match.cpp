// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "event_matching.h"
#include "json_output.h"
#include "lsm_text_io.h"
#include "numbers.h"
#include "option_values.h"
#include "plot.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  MatchRule rule;
  Threshold threshold;
  double origin = 0.0;
};

/// Times since the origin, which is a model time also where the times are ways of the plates.
void count_from(EventTable &table, double origin, bool displacement) {
  double velocity = 1.0;
  if (displacement) text_io::parse(*table.info.find("velocity"), velocity);
  const double shift = origin * std::fabs(velocity);
  for (std::vector<double> *times : {&table.t_start, &table.t_end})
    for (double &time : *times) time -= shift;
  table.last_end -= shift;
}

void run(Options &options) {
  if (options.catalogues.paths.size() < 2)
    throw std::invalid_argument("one catalogue, expected at least two to compare");
  options.json.check(options.catalogues.paths);
  options.rule.least_size = options.threshold.given_or_paper();
  std::vector<EventTable> tables = load_catalogues(options.catalogues);
  Table out({"first", "second", "smallest_size", "n_first", "n_second", "same", "chance"});
  for (EventTable &table : tables)
    count_from(table, options.origin, options.catalogues.displacement);
  const EventTable &first = tables.front();
  for (std::size_t i = 1; i < tables.size(); ++i) {
    const EventTable &second = tables[i];
    EventMatches matches;
    try {
      matches = match_events(first, second, options.rule);
    } catch (const std::invalid_argument &e) {
      throw std::runtime_error(fmt::format("{} and {}: {}", first.path, second.path, e.what()));
    }
    fmt::print("{}: {} of {} events of size {} or larger are in {} (of {}), by chance {}\n",
               first.label, matches.same, matches.first, short_number(options.rule.least_size),
               second.label, matches.second, short_number(matches.chance));
    out.add(first.label).add(second.label).add(options.rule.least_size).add(matches.first);
    out.add(matches.second).add(matches.same).add(matches.chance).end_row();
  }
  options.json.add("matches", out);
  options.json.write();
}

}  // namespace

void add_match(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "match",
      "How many events of the first catalogue are in each of the others: start at about the same "
      "time, of about the same size, each counted once; and how many are found by chance, with the "
      "first catalogue shifted in time (ours)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->catalogues.add_displacement(command);
  options->json.add_to(command);
  add_threshold(command, options->threshold, "the events")
      ->description("Smallest size of the events (model energy)")
      ->check(CLI::PositiveNumber)
      ->default_str("")
      ->required();
  command
      ->add_option("--within", options->rule.within,
                   "Starts of the same event differ by less than this (model time, or way)")
      ->check(CLI::PositiveNumber)
      ->required();
  command
      ->add_option("--factor", options->rule.factor, "Sizes differ by less than this factor, > 1")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--origin", options->origin,
                   "Model time from which the times of both are reckoned, where the plates begin "
                   "to move for example")
      ->check(zero_or_more());
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
