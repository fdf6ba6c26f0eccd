// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "new_file.h"

namespace LSM::postproc {

namespace {

/// The header of the original, with a note of what was selected from it.
CatalogueInfo header_of(const EventTable &table, const CatalogueOptions &options) {
  CatalogueInfo info = table.info;
  std::string what;
  const auto add = [&what](const std::string &text) { what += (what.empty() ? "" : ", ") + text; };
  if (std::isfinite(options.from_time)) add("t_start from " + text::number(options.from_time));
  if (std::isfinite(options.to_time)) add("t_start below " + text::number(options.to_time));
  if (std::isfinite(options.min_size)) add("size from " + text::number(options.min_size));
  if (table.complete_from > 0.0)
    set_parameter(info.parameters, "min_size", text::number(table.complete_from));
  for (const std::string &condition : options.where) add(condition);
  if (what.empty()) what = "all events";
  if (const std::string *before = info.find("selected")) what = *before + "; " + what;
  set_parameter(info.parameters, "selected", what);
  return info;
}

class Select : public CatalogueAnalysis {
  const char *help() const override {
    return "Writes the events of a model's catalogue that --from, --to, --min-size and --where select as "
           "a catalogue: numbers and columns unchanged, and the selection in the header †";
  }

  void add_options(CLI::App *command) override {
    add_catalogues(command, catalogues);
    // By default events of negative size are kept as well.
    catalogues.min_size = -std::numeric_limits<double>::infinity();
    OptionGroup group(command);
    for (const char *const name : {"--label", "--region", "--format"}) group.remove(name);
    add_file(group, "Catalogue to write");
  }

  Results find() override {
    if (catalogues.paths.size() != 1)
      throw std::invalid_argument(
          fmt::format("{} catalogues, expected one", catalogues.paths.size()));
    check(catalogues);
    const auto file = std::make_shared<ClaimedFile<CatalogueWriter>>(file_, overwrite);
    CatalogueWriter &writer = file->writer;
    const EventTable table = read_events(
        catalogues.paths.front(), catalogues, [&](const EventRow &event) { writer.write(event); },
        [&](const EventTable &of) {
          if (of.earthquakes())
            throw std::invalid_argument(of.path + ": earthquakes, expected a catalogue of a model");
          check_kinds(catalogues, 0, 1);
          writer.create(file_, header_of(of, catalogues), true);
        });
    state_repairs(table);
    Results results;
    results.say(fmt::format(
        "{} events; left out: {} by time, {} by size{}\n", writer.rows(), table.left_out_time,
        table.left_out_small,
        catalogues.where.empty() ? "" : fmt::format(", {} by --where", table.left_out_where)));
    results.file(file_, [file] { file->writer.close(); });
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_select() { return std::make_shared<Select>(); }

}  // namespace LSM::postproc
