// SPDX-License-Identifier: GPL-2.0-or-later
#include "catalogue_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "event_condition.h"
#include "input_file.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/parameters.h"
#include "files/text.h"
#include "numerics/huge_pages.h"
#include "samples.h"

namespace LSM::postproc {

namespace {

/// A unit of model time in the unit of the requested times.
double time_unit(const CatalogueInfo &info, const std::string &path, bool displacement) {
  if (!displacement) return 1.0;
  double velocity = 0.0;
  const std::string *text = info.find("velocity");
  if (!text || !text::parse(*text, velocity) || !(std::fabs(velocity) > 0.0))
    throw FileError(path + ": " + (text ? "velocity = " + *text : "no velocity") +
                    " in the header, expected one that is not 0 for --displacement");
  return std::fabs(velocity);
}

std::string label_of(const EventTable &table) {
  const double length = table.length();
  if (std::isnan(length)) return std::filesystem::path(table.path).stem().string();
  return table.info.model == "lsm" ? fmt::format("fault, length {}", length)
                                   : fmt::format("block-slider, N = {}", length);
}

}  // namespace

void set_parameter(files::Parameters &parameters, const std::string &key,
                   const std::string &value) {
  for (auto &[name, old] : parameters)
    if (name == key) {
      old = value;
      return;
    }
  parameters.emplace_back(key, value);
}

namespace {

/// Passes an event to `use` if it starts within [from, to) and is large enough.
/// \throws FileError if a number is so large that its square could overflow
/// \return whether it did
bool choose(const ReadEvent &event, double from, double to, const CatalogueOptions &options,
            EventTable &table, const UseEvent &use) {
  constexpr double largest = 1e100;
  for (const double number :
       {event.t_start, event.t_end, event.size, table.info.number(event, "slip_moment")})
    if (!(std::fabs(number) <= largest))
      throw FileError(fmt::format("{}: event {} has a time or size of {}, expected at most {}",
                                  table.path, event.id, number, largest));
  if (is_before(event.t_start, from) || !is_before(event.t_start, to))
    ++table.left_out_time;
  else if (event.size < options.min_size)
    ++table.left_out_small;
  else {
    table.in_events += event.t_end - event.t_start;
    table.last_end = event.t_end;
    use(event);
    return true;
  }
  return false;
}

EventTable read_earthquake_events(files::Bytes &bytes, const std::string &format,
                                  const CatalogueOptions &options, const UseEvent &use,
                                  const UseTable &begin) {
  const std::string &path = bytes.path();
  if (options.displacement)
    throw FileError(path + ": earthquakes, expected a catalogue of a model for --displacement");
  if (!options.where.empty())
    throw FileError(path + ": earthquakes, expected a catalogue of a model for --where");
  const EarthquakeList list = read_earthquakes(bytes, format, options.lenient);
  EventTable table;
  table.path = path;
  table.info.model = seismicity;
  table.label = std::filesystem::path(path).filename().string();
  table.label = table.label.substr(0, table.label.find('.'));
  if (!options.regions.empty()) {
    table.region = options.regions.front();
    table.label += " " + table.region;
  }
  begin(table);
  std::int64_t elsewhere = 0;
  for (const Earthquake &one : list.events) {
    if (!table.region.empty() && !parse_region(table.region).contains(one)) {
      ++elsewhere;
      continue;
    }
    ReadEvent event;
    event.id = static_cast<std::int64_t>(table.magnitudes.size()) + 1;
    event.t_start = event.t_end = one.time;
    event.size = size_of_magnitude(one.magnitude);
    event.earthquake = &one;
    if (!choose(event, options.from_day, options.to_day, options, table, use)) continue;
    table.magnitudes.push_back(one.magnitude);
    if (table.complete_from == 0.0 || event.size < table.complete_from)
      table.complete_from = event.size;
  }
  table.bins = recognized_bins(table.magnitudes);
  table.bins_given = options.magnitude_bins.has_value();
  const double of_file = table.bins.width;
  if (table.bins_given) table.bins = *options.magnitude_bins;
  table.complete_from = std::max(table.complete_from, options.min_size);
  // Of a bin that is wider than those of the file, the part below the smallest magnitude is empty.
  if (const double wider = table.bins.width - of_file; wider > 0.0 && table.complete_from > 0.0)
    table.complete_from = size_of_magnitude(magnitude_of_size(table.complete_from) + 0.5 * wider);
  const auto left_out = [&](std::int64_t count, const std::string &what) {
    if (count > 0) table.repairs.push_back(fmt::format("{}: left out {} {}", path, count, what));
  };
  for (const auto &[type, count] : list.others) left_out(count, "of type '" + type + "'");
  left_out(list.without_magnitude, "without magnitude");
  for (const auto &[text, count] : list.fillers)
    left_out(count, "of magnitude " + text + ", which stands for none");
  left_out(list.without_origin, "without origin");
  if (list.not_preferred > 0)
    table.repairs.push_back(
        fmt::format("{}: the preferred origin or magnitude is missing, the first is used: {}", path,
                    list.not_preferred));
  left_out(elsewhere, "outside of " + table.region);
  left_out(list.bad_lines, "that cannot be read; the first was " + list.first_problem);
  table.skipped_lines = list.bad_lines;
  return table;
}

EventTable read_model_events(std::unique_ptr<files::Bytes> bytes, const CatalogueOptions &options,
                             const UseEvent &use, const UseTable &begin) {
  const std::string path = bytes->path();
  CatalogueReader reader(std::move(bytes), options.lenient);
  EventTable table;
  table.path = path;
  table.info = reader.info();
  table.label = label_of(table);
  // The reader has refused headers whose min_size is not a number.
  if (const std::string *text = table.info.find("min_size"))
    text::parse(*text, table.complete_from);
  table.complete_from = std::max(table.complete_from, options.min_size);
  table.completeness = table.info.completeness();
  table.completeness_path = path;
  const double unit = table.model_time = time_unit(table.info, path, options.displacement);
  EventConditions where(options.where, table.info, path);
  table.complete_from = std::max(table.complete_from, where.least_size());
  begin(table);
  const auto take = [&](ReadEvent &event) {
    if (!where.hold(event)) {
      ++table.left_out_where;
      return;
    }
    event.t_start *= unit;
    event.t_end *= unit;
    choose(event, options.from_time, options.to_time, options, table, use);
  };
  ReadEvent event;
  std::vector<ReadEvent> all;
  const bool all_first = where.needs_friction_between();
  while (reader.next(event)) {
    if (all_first)
      all.push_back(event);
    else
      take(event);
  }
  if (all_first) {
    const auto within = [&](const ReadEvent &one) {
      const double time = one.t_start * unit;
      return !is_before(time, options.from_time) && is_before(time, options.to_time);
    };
    const ReadEvent *before = nullptr;
    for (const ReadEvent &one : all) {
      if (!within(one)) continue;
      if (before) where.add_friction_between(*before, one);
      before = &one;
    }
    if (!where.has_friction_between())
      throw FileError(path +
                      ": no time between events from --from to --to, expected two or more apart "
                      "for --where excess");
    std::for_each(all.begin(), all.end(), take);
  }
  table.skipped_lines = reader.skipped();
  table.repairs = reader.repairs();
  if (reader.skipped() > 0) table.repairs.push_back("the first was " + reader.first_problem());
  return table;
}

}  // namespace

EventTable read_events(const std::string &path, const CatalogueOptions &options,
                       const UseEvent &use, const UseTable &begin) {
  // The format is detected on the open file, as a pipe can be read only once.
  std::unique_ptr<files::Bytes> bytes = open_input(path);
  const std::string_view head = bytes->peek(head_size);
  if (head.empty())
    throw FileError(fmt::format(
        "{}empty file{}, expected '{}1' of a model, or earthquakes", text::where(path, 1),
        bytes->size() < 0 ? ", or a pipe that can be read only once" : "", catalogue_magic));
  const std::string format = options.format == "detect" ? detect_format(head) : options.format;
  if (options.format == "detect" && format == "models" && !head.empty() &&
      head.find(catalogue_magic) > 3 /* of a byte order mark */ && !files::is_utf16(head))
    throw FileError(fmt::format("{}not a catalogue, expected '{}1' of a model, or earthquakes: {}",
                                text::where(path, 1), catalogue_magic, earthquake_formats));
  return format == "models" ? read_model_events(std::move(bytes), options, use, begin)
                            : read_earthquake_events(*bytes, format, options, use, begin);
}

namespace {

/// Keeps the `most` largest events, and those as large as the smallest of them.
void keep_largest(std::vector<EventRow> &events, std::size_t most) {
  if (events.size() <= most) return;
  const double least = nth_largest(column(events, &Event::size), most);
  events.erase(std::remove_if(events.begin(), events.end(),
                              [least](const EventRow &event) { return event.size < least; }),
               events.end());
}

}  // namespace

EventTable read_all(const std::string &path, const CatalogueOptions &options) {
  std::vector<EventSummary> events;
  std::vector<EventRow> details;
  // Reserves memory for as many events as the file can have, with lines of the shortest possible
  // length: a growing vector would touch each page twice.
  std::error_code ignored;
  constexpr std::uintmax_t shortest_line = 40;
  const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
  if (!ignored) events.reserve(bytes / shortest_line);
  ask_for_huge_pages(events.data(), events.capacity() * sizeof(EventSummary));
  std::size_t room = 2 * options.details;
  EventTable table = read_events(path, options, [&](const EventRow &event) {
    events.push_back(event);
    if (options.details == 0) return;
    details.push_back(event);
    if (details.size() < room) return;
    keep_largest(details, options.details);
    room = 2 * details.size();
  });
  keep_largest(details, options.details);
  table.events = std::move(events);
  table.details = std::move(details);
  return table;
}

EventTable load_catalogue(const std::string &path, const CatalogueOptions &options) {
  EventTable table = read_all(path, options);
  // Inter-event times are from start to start, but catalogues with overlapping events are in order
  // of their ends.
  const auto earlier = [](const EventSummary &a, const EventSummary &b) {
    return a.t_start < b.t_start;
  };
  if (table.info.overlapping()) {
    std::stable_sort(table.events.begin(), table.events.end(), earlier);
    std::stable_sort(table.details.begin(), table.details.end(), earlier);
  }
  return table;
}

void expect_each(const char *option, std::size_t given, const char *of, std::size_t count) {
  if (given > 0 && given != count)
    throw std::invalid_argument(
        fmt::format("{} given {} times, expected once per {} ({})", option, given, of, count));
}

void check(const CatalogueOptions &options) {
  if (!(options.from_time < options.to_time))
    throw std::invalid_argument(fmt::format("--from {} --to {}: expected --from before --to",
                                            options.from_time, options.to_time));
  if (options.regions.empty())
    expect_each("--label", options.labels.size(), "catalogue", options.paths.size());
  for (const std::string &region : options.regions) parse_region(region);
  for (const std::string &condition : options.where) parse_condition(condition);
  if (!(options.from_day < options.to_day))
    throw std::invalid_argument("--from is no earlier date than --to, expected --from before --to");
}

void check_kinds(const CatalogueOptions &options, std::size_t quakes, std::size_t all) {
  if (quakes == 0 && (std::isfinite(options.from_day) || std::isfinite(options.to_day)))
    throw std::invalid_argument(
        "--from or --to is a date, but no catalogue is of earthquakes, expected a model time");
  if (quakes == 0 && options.magnitude_bins)
    throw std::invalid_argument("--magnitude-bin, but no catalogue is of earthquakes");
  if (quakes == 0 && !options.regions.empty())
    throw std::invalid_argument("--region, but no catalogue is of earthquakes");
  if (quakes == all && (std::isfinite(options.from_time) || std::isfinite(options.to_time)))
    throw std::invalid_argument(
        "--from or --to is a number, but all catalogues are of earthquakes, expected a date such "
        "as "
        "1984-01-01");
  expect_each("--label", options.labels.size(), "catalogue and region", all);
}

void state_repairs(const EventTable &table) {
  for (const std::string &repair : table.repairs) fmt::print(stderr, "postproc: {}\n", repair);
}

void for_each_catalogue(const CatalogueOptions &options, const UseCatalogue &use) {
  check(options);
  CatalogueOptions one = options;
  const std::size_t regions = std::max<std::size_t>(1, options.regions.size());
  std::size_t quakes = 0, all = 0;
  for (const std::string &path : options.paths)
    for (std::size_t i = 0; i < regions; ++i) {
      if (!options.regions.empty()) one.regions = {options.regions[i]};
      ++all;
      if (!use(path, one)) break;
      ++quakes;
    }
  check_kinds(options, quakes, all);
}

namespace {

/// Derives the name of a run from the name of its catalogue.
std::string run_of(const std::string &path) {
  std::string name = std::filesystem::path(path).filename().string();
  for (const std::string_view ending : {".gz", ".xz", ".csv", ".catalogue"})
    if (name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
      name.resize(name.size() - ending.size());
  return name;
}

/// Distinguishes catalogues of the same label by the names of their files, or by their paths.
void tell_apart(std::vector<EventTable> &tables) {
  std::map<std::string, std::vector<EventTable *>> same;
  for (EventTable &table : tables) same[table.label].push_back(&table);
  for (auto &[label, group] : same) {
    if (group.size() == 1) continue;
    std::set<std::string> names;
    for (const EventTable *table : group) names.insert(run_of(table->path));
    const bool enough = names.size() == group.size();
    for (EventTable *table : group)
      table->label += " (" + (enough ? run_of(table->path) : table->path) + ")";
  }
}

}  // namespace

std::vector<EventTable> load_catalogues(const CatalogueOptions &options) {
  std::vector<EventTable> tables;
  for_each_catalogue(options, [&](const std::string &path, const CatalogueOptions &one) {
    tables.push_back(load_catalogue(path, one));
    return tables.back().earthquakes();
  });
  tell_apart(tables);
  for (std::size_t i = 0; i < options.labels.size(); ++i) tables[i].label = options.labels[i];
  for (std::size_t i = 0; i < tables.size(); ++i) {
    for (const EventTable &other : tables) {
      if (other.info.model != tables[i].info.model || other.kind() != tables[i].kind() ||
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
