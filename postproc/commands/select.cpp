// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "lsm_output_claim.h"
#include "lsm_text_io.h"
#include "new_file.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  std::string output;
  bool force = false;
};

void set(CatalogueInfo &info, const std::string &key, const std::string &value) {
  for (auto &[name, old] : info.parameters)
    if (name == key) {
      old = value;
      return;
    }
  info.parameters.emplace_back(key, value);
}

/// The header of the original with what was selected from it.
CatalogueInfo header_of(const EventTable &table, const CatalogueOptions &options) {
  CatalogueInfo info = table.info;
  std::string what;
  const auto add = [&what](const std::string &text) { what += (what.empty() ? "" : ", ") + text; };
  if (std::isfinite(options.from_time)) add("t_start from " + text_io::number(options.from_time));
  if (std::isfinite(options.to_time)) add("t_start below " + text_io::number(options.to_time));
  if (std::isfinite(options.min_size)) {
    add("size from " + text_io::number(options.min_size));
    set(info, "min_size", text_io::number(table.complete_from));
  }
  if (what.empty()) what = "all events";
  if (const std::string *before = info.find("selected")) what = *before + "; " + what;
  set(info, "selected", what);
  return info;
}

void run(Options &options) {
  if (options.catalogues.paths.size() != 1)
    throw std::invalid_argument(
        fmt::format("{} catalogues, expected one", options.catalogues.paths.size()));
  const std::string &path = options.catalogues.paths.front();
  check_outputs({{"--output", options.output}}, {path});
  check(options.catalogues);
  std::vector<Event> events;
  const EventTable table = read_events(path, options.catalogues,
                                       [&events](const Event &event) { events.push_back(event); });
  if (table.earthquakes())
    throw std::invalid_argument(path + ": earthquakes, expected a catalogue of a model");
  const FileLock lock = claim_output(options.output, options.force);
  CatalogueWriter writer;
  writer.create(options.output, header_of(table, options.catalogues), true);
  for (const Event &event : events) writer.write(event);
  writer.close();
  state_repairs(table);
  fmt::print("{} events; left out: {} by time, {} by size\nwrote {}\n", events.size(),
             table.left_out_time, table.left_out_small, options.output);
}

}  // namespace

void add_select(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "select",
      "Writes the events of a catalogue of a model that --from, --to and --min-size choose as a "
      "catalogue again: numbers and columns as they were, and in the header what was selected "
      "(ours)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  // Events of negative size are left out only where a size is asked for.
  options->catalogues.min_size = -std::numeric_limits<double>::infinity();
  for (const char *const name : {"--label", "--region", "--format"})
    command->remove_option(command->get_option(name));
  command->add_option("-o,--output", options->output, "Catalogue to write")->required();
  command->add_flag("--force", options->force, "Replace the catalogue if it exists");
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
