// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "numbers.h"
#include "option_values.h"
#include "plot.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  std::vector<double> sizes = {1e-4, 1e-3, 1e-2, 1e-1};
  std::int64_t brief = 0;
};

/// Events of one catalogue from a size on.
struct Count {
  double size = 0.0;
  std::int64_t events = 0, brief = 0;
  double released = 0.0;
};

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  check(options.catalogues);
  std::sort(options.sizes.begin(), options.sizes.end());
  Table catalogues({"label", "events", "first_start", "last_start", "last_end", "last_step",
                    "largest", "share_in_events"});
  Table sizes({"label", "size", "events", "brief", "released", "mean_time"});
  const bool labelled = !options.catalogues.labels.empty();
  for (std::size_t i = 0; i < options.catalogues.paths.size(); ++i) {
    std::vector<Count> counts;
    for (const double size : options.sizes) counts.push_back({size});
    std::int64_t events = 0, last_step = 0;
    double first = std::numeric_limits<double>::quiet_NaN(), last = first, largest = first;
    EventTable table =
        read_events(options.catalogues.paths[i], options.catalogues, [&](const Event &event) {
          if (events++ == 0) first = event.t_start;
          last = event.t_start;
          last_step = event.step_end;
          largest = std::fmax(largest, event.size);
          for (Count &count : counts)
            if (event.size >= count.size) {
              ++count.events;
              count.brief += event.step_end - event.step_start <= options.brief;
              count.released += event.size;
            }
        });
    state_repairs(table);
    const std::string label = labelled ? options.catalogues.labels[i] : table.label;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double span = table.last_end - first;
    const double share = table.info.overlapping() ? nan : table.in_events / span;
    catalogues.add(label).add(events).add(first).add(last);
    catalogues.add(table.last_end).add(last_step).add(largest).add(share);
    catalogues.end_row();
    fmt::print("{}: {} events, {} of the time, steps up to {}\n", label, events,
               short_number(share), last_step);
    for (const Count &count : counts) {
      const double mean = span / static_cast<double>(count.events);
      sizes.add(label).add(count.size).add(count.events).add(count.brief).add(count.released);
      sizes.add(count.events > 0 ? mean : nan).end_row();
      fmt::print("  from {}: {} events, sizes in all {}\n", short_number(count.size), count.events,
                 short_number(count.released));
    }
  }
  options.json.add("catalogues", catalogues);
  options.json.add("sizes", sizes);
  options.json.write();
}

}  // namespace

void add_count(CLI::App &app) {
  CLI::App *command =
      app.add_subcommand("count",
                         "Number of events above several sizes, the total energy that these "
                         "release, and the share of the time that events last (ours)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->catalogues.add_displacement(command);
  options->json.add_to(command);
  command->add_option("--size", options->sizes, "Smallest size (model energy), several allowed")
      ->allow_extra_args(false)
      ->check(zero_or_more());
  command
      ->add_option("--brief", options->brief,
                   "Events of at most so many steps are counted as brief, too: at time steps that "
                   "are too large, bursts of numbers gone wrong")
      ->check(zero_or_more());
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
