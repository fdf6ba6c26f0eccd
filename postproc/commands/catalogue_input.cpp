// SPDX-License-Identifier: GPL-2.0-or-later
#include "catalogue_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "option_values.h"

namespace LSM::postproc {

void CatalogueOptions::add_to(CLI::App *command) {
  const std::string group = "Catalogues";
  command
      ->add_option(
          "catalogues", paths,
          "Catalogue files of either model, one curve each; written by compute lsm/events, "
          "slider_cli or postproc pick")
      ->required()
      ->type_name("FILE")
      ->default_str("")
      ->group(group);
  command
      ->add_option("--label", labels,
                   "Name of a curve, once per catalogue and in their order (default: the model and "
                   "its length or number of blocks, from the header)")
      ->type_name("TEXT")
      ->default_str("")
      ->group(group);
  command
      ->add_flag("--lenient", lenient,
                 "Pass over lines that cannot be read (truncated last line, missing columns, NaN, "
                 "events out of order), count them and say so on standard error; without it the "
                 "first of them is an error. A wrong version or header is always one")
      ->group(group);
  command->add_option("--min-size", min_size, "Leave out events smaller than this (energy)")
      ->group(group);
  command
      ->add_option("--from", from_time,
                   "Leave out events that start before this time, e.g. the warm-up (model time)")
      ->default_str("start")
      ->group(group);
  command
      ->add_option("--to", to_time,
                   "Leave out events that start at this time or later (model time)")
      ->default_str("end")
      ->group(group);
}

void CatalogueOptions::add_displacement(CLI::App *command) {
  command
      ->add_flag("--displacement", displacement,
                 "Times as the way of the driving plate, model time times the 'velocity' in the "
                 "header, also those of --from and --to: for catalogues of different driving "
                 "velocities (ours)")
      ->group("Catalogues");
}

namespace {

/// Model time in the unit of the times asked for.
double time_unit(const CatalogueInfo &info, const std::string &path, bool displacement) {
  if (!displacement) return 1.0;
  double velocity = 0.0;
  const std::string *text = info.find("velocity");
  if (!text || !text_io::parse(*text, velocity) || !(std::fabs(velocity) > 0.0))
    throw CatalogueError(path + ": " + (text ? "velocity = " + *text : "no velocity") +
                         " in the header, expected one that is not 0 for --displacement");
  return std::fabs(velocity);
}

std::string label_of(const EventTable &table) {
  const double length = table.length();
  if (std::isnan(length)) return std::filesystem::path(table.path).stem().string();
  return table.info.model == "lsm" ? fmt::format("fault, length {}", length)
                                   : fmt::format("block-slider, N = {}", length);
}

// Times between events are reckoned from start to start, but ruptures come in order of their ends.
void sort_by_start(EventTable &table) {
  std::vector<std::size_t> order(table.size.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&table](std::size_t i, std::size_t j) {
    return table.t_start[i] < table.t_start[j];
  });
  for (std::vector<double> *column :
       {&table.t_start, &table.t_end, &table.size, &table.begin, &table.extent}) {
    if (column->empty()) continue;
    std::vector<double> sorted;
    sorted.reserve(order.size());
    for (const std::size_t i : order) sorted.push_back((*column)[i]);
    *column = std::move(sorted);
  }
}

}  // namespace

CLI::Option *add_threshold(CLI::App *command, Threshold &threshold, const std::string &what) {
  return command
      ->add_option_function<double>(
          "--threshold", [&threshold](const double &size) { threshold = Threshold(size); },
          "Smallest size of " + what +
              " (model energy); without it 1e-4, as in the paper's Figs. 12 and 13, or the largest "
              "'completeness' in the headers of a model where that is larger (ours)")
      ->check(zero_or_more())
      ->default_str("1e-4");
}

void check(const CatalogueOptions &options) {
  if (std::isnan(options.min_size))
    throw std::invalid_argument("--min-size is not a number, expected a size");
  if (!(options.from_time < options.to_time))
    throw std::invalid_argument(fmt::format("--from {} --to {}: expected --from before --to",
                                            options.from_time, options.to_time));
  if (!options.labels.empty() && options.labels.size() != options.paths.size())
    throw std::invalid_argument(
        fmt::format("--label given {} times, expected once per catalogue ({})",
                    options.labels.size(), options.paths.size()));
}

EventTable read_events(const std::string &path, const CatalogueOptions &options,
                       const std::function<void(const Event &)> &use) {
  CatalogueReader reader(path, options.lenient);
  EventTable table;
  table.path = path;
  table.info = reader.info();
  table.label = label_of(table);
  if (const std::string *text = table.info.find("min_size"))
    text_io::parse(*text, table.complete_from);
  table.complete_from = std::max(table.complete_from, options.min_size);
  table.completeness = table.info.completeness();
  table.completeness_path = path;
  const double unit = time_unit(table.info, path, options.displacement);
  Event event;
  while (reader.next(event)) {
    event.t_start *= unit;
    event.t_end *= unit;
    if (event.t_start < options.from_time || event.t_start >= options.to_time)
      ++table.left_out_time;
    else if (event.size < options.min_size)
      ++table.left_out_small;
    else {
      table.in_events += event.t_end - event.t_start;
      table.last_end = event.t_end;
      use(event);
    }
  }
  table.skipped_lines = reader.skipped();
  table.repairs = reader.repairs();
  if (reader.skipped() > 0) table.repairs.push_back("the first was " + reader.first_problem());
  return table;
}

EventTable load_catalogue(const std::string &path, const CatalogueOptions &options) {
  EventTable columns;
  EventTable table = read_events(path, options, [&columns](const Event &event) {
    columns.t_start.push_back(event.t_start);
    columns.t_end.push_back(event.t_end);
    columns.size.push_back(event.size);
    columns.begin.push_back(event.x_begin);
    columns.extent.push_back(event.rupture_length);
  });
  table.t_start = std::move(columns.t_start);
  table.t_end = std::move(columns.t_end);
  table.size = std::move(columns.size);
  if (table.info.x_begin && table.info.rupture_length) {
    table.begin = std::move(columns.begin);
    table.extent = std::move(columns.extent);
  }
  if (table.info.overlapping()) sort_by_start(table);
  return table;
}

void state_repairs(const EventTable &table) {
  for (const std::string &repair : table.repairs) fmt::print(stderr, "postproc: {}\n", repair);
}

std::vector<EventTable> load_catalogues(const CatalogueOptions &options) {
  check(options);
  std::vector<EventTable> tables;
  for (const std::string &path : options.paths) tables.push_back(load_catalogue(path, options));
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t j = i + 1; j < tables.size(); ++j)
      if (tables[i].label == tables[j].label)
        tables[j].label += " (" + std::filesystem::path(tables[j].path).stem().string() + ")";
  for (std::size_t i = 0; i < options.labels.size(); ++i) tables[i].label = options.labels[i];
  for (std::size_t i = 0; i < tables.size(); ++i) {
    for (const EventTable &other : tables) {
      if (other.info.model != tables[i].info.model ||
          other.info.overlapping() != tables[i].info.overlapping() ||
          !(other.completeness > tables[i].completeness))
        continue;
      tables[i].completeness = other.completeness;
      tables[i].completeness_path = other.completeness_path;
    }
  }
  for (const EventTable &table : tables) state_repairs(table);
  return tables;
}

}  // namespace LSM::postproc
