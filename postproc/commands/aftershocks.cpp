// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "aftershock_figure.h"
#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  Threshold threshold;
  std::optional<double> main_size, window;
  double share = 0.02, first = 0.0;
  double hold_c = std::numeric_limits<double>::quiet_NaN();
  double factor = 1.5848931924611136;  // five bins a decade
  int replicas = 100;
  std::uint64_t seed = 1;
};

SequenceRule rule_for(const EventTable &table, const Options &options) {
  SequenceRule rule;
  rule.least_size = options.threshold.complete_in(table).size;
  rule.first = options.first;
  std::vector<double> sizes;
  for (const double size : table.size)
    if (size >= rule.least_size) sizes.push_back(size);
  if (sizes.size() < 2)
    throw std::runtime_error(fmt::format("{}: {} events of size {} or larger, expected at least 2",
                                         table.path, sizes.size(), short_number(rule.least_size)));
  std::sort(sizes.begin(), sizes.end(), std::greater<double>());
  const auto rank = static_cast<std::size_t>(options.share * static_cast<double>(sizes.size()));
  rule.main_size = options.main_size.value_or(sizes[std::min(rank, sizes.size() - 1)]);
  const auto large = std::count_if(sizes.begin(), sizes.end(),
                                   [&rule](double size) { return size >= rule.main_size; });
  if (large == 0)
    throw std::runtime_error(
        fmt::format("{}: no event of size {} or larger, expected a smaller --main-size", table.path,
                    short_number(rule.main_size)));
  const double span = table.t_start.back() - table.t_start.front();
  rule.window = options.window.value_or(0.2 * span / static_cast<double>(large));
  return rule;
}

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  options.picture.check(options.catalogues.paths, {".omori.csv"}, {options.json.output()});
  const std::vector<EventTable> tables = load_catalogues(options.catalogues);
  std::vector<AftershockCurve> curves;
  for (const EventTable &table : tables)
    curves.push_back({table.label, table.info.model,
                      aftershocks_of(table, rule_for(table, options), options.hold_c,
                                     options.factor, options.replicas, options.seed)});
  // A catalogue without aftershocks is a result as well, only there is nothing to draw.
  const bool none = std::all_of(curves.begin(), curves.end(), [](const AftershockCurve &curve) {
    return curve.aftershocks.bins.empty();
  });
  std::optional<Figure> figure;
  if (!none || !options.picture.no_picture) figure = aftershock_figure(curves);
  for (const std::string &line : texts(options.threshold, tables)) fmt::print("{}\n", line);
  fmt::print("{}", aftershocks_text(curves));
  const std::string table = options.picture.output + ".omori.csv";
  const Table laws = aftershocks_csv(curves);
  laws.write(table);
  fmt::print("wrote {}\n", table);
  if (figure) make(*figure, options.picture);
  options.json.add("laws", laws);
  if (figure) options.json.add("rates", figure->table);
  options.json.write();
}

}  // namespace

void add_aftershocks(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "aftershocks",
      "Rate of events after main shocks, all sequences stacked, the Omori-Utsu law n(t) = K (t + "
      "c)^-p + background fitted to it by maximum likelihood (Utsu 1961, Ogata 1983), and the same "
      "for Poisson catalogues of the same events. A main shock is the largest of all events that "
      "start within a window before its start to a window after its end. All ours: the paper does "
      "not look for aftershocks");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "aftershocks");
  const std::string group = "Sequences";
  add_threshold(command, options->threshold, "the events that are counted")->group(group);
  auto *main_size =
      command->add_option("--main-size", options->main_size, "Smallest main shock (model energy)");
  main_size->transform(size_or_magnitude())
      ->check(CLI::PositiveNumber)
      ->default_str("from --main-share")
      ->group(group);
  command
      ->add_option("--main-share", options->share,
                   "Share of the counted events that are large enough for a main shock")
      ->check(CLI::Range(0.0, 1.0))
      ->excludes(main_size)
      ->group(group);
  command
      ->add_option("--window", options->window,
                   "Time before and after a main shock without a larger event, and for which "
                   "events are counted after it (model time)")
      ->check(CLI::PositiveNumber)
      ->default_str("1/5 of the mean time between events of the main size")
      ->group(group);
  command
      ->add_option("--first", options->first,
                   "Events sooner than this after the end of a main shock are not counted (model "
                   "time)")
      ->check(zero_or_more())
      ->group(group);
  command
      ->add_option("--hold-c", options->hold_c,
                   "Hold c at this value (model time; 0 needs --first above 0)")
      ->check(zero_or_more())
      ->default_str("fitted")
      ->group(group);
  command
      ->add_option("--bin-factor", options->factor,
                   "Ratio of the edges of a bin of the picture: five bins a decade")
      ->group(group);
  command->add_option("--replicas", options->replicas, "Poisson catalogues; 0: none")
      ->check(zero_or_more())
      ->group(group);
  add_seed(command, options->seed)->group(group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
