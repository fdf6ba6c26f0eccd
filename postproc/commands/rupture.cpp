// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "commands.h"
#include "json_output.h"
#include "numbers.h"
#include "option_values.h"
#include "picture_options.h"
#include "plot.h"
#include "rupture_densities.h"
#include "rupture_figures.h"

namespace LSM::postproc {

namespace {

struct Options {
  CatalogueOptions catalogues;
  JsonOutput json;
  PictureOptions picture;
  std::string history;
  std::int64_t event = 0;
  double locked = 0.0, slipping = 0.0;
  double p_speed = 2.12, s_speed = 1.22;
};

/// \throws FileError; std::runtime_error unless it is a catalogue of ruptures of a fault
RuptureTable load_ruptures(const std::string &path, const CatalogueOptions &options) {
  RuptureTable table;
  table.head = read_events(path, options, [&table](const Event &e) { table.events.push_back(e); });
  const CatalogueInfo &info = table.head.info;
  if (info.model != "lsm" || !info.overlapping() || !info.slip_moment || !info.rupture_length ||
      !info.x_hypocentre || !info.stress_drop)
    throw std::runtime_error(path +
                             ": no catalogue of ruptures of a fault, expected one of compute "
                             "lsm/events with events ruptures");
  return table;
}

Table line_table() { return Table({"curve", "x", "y"}); }

const Event &chosen(const std::vector<Event> &events, std::int64_t id, const std::string &path) {
  if (id != 0) {
    for (const Event &e : events)
      if (e.id == id) return e;
    throw std::runtime_error(fmt::format("{}: no event {} among those chosen", path, id));
  }
  if (events.empty()) throw std::runtime_error(path + ": no events, expected at least one");
  return *std::max_element(events.begin(), events.end(), [](const Event &a, const Event &b) {
    return a.slip_moment < b.slip_moment;
  });
}

void draw_history(const Options &options, const RuptureTable &catalogue) {
  const CatalogueOptions &window_options = options.catalogues;
  const HistoryWindow window = load_history(options.history, window_options.lenient,
                                            window_options.from_time, window_options.to_time);
  // Everything about the history is found out before the first file is written.
  std::vector<Event> inside;
  for (const Event &e : catalogue.events)
    if (e.t_start >= window.from && e.t_end <= window.to) inside.push_back(e);
  const Event event = chosen(inside, options.event, catalogue.head.path);
  const double room = 0.15 * (event.t_end - event.t_start);
  const HistoryWindow detail = load_history(options.history, window_options.lenient,
                                            event.t_start - room, event.t_end + room);

  Table outlines = line_table(), lines = line_table();
  const PictureOptions space_time = named(options.picture, "-spacetime");
  const Figure picture = space_time_figure(window, outlines);
  outlines.write(space_time.output + "-outlines.csv");
  make(picture, space_time);
  const double span = window.to - window.from;
  const double locked = options.locked > 0.0 ? options.locked : span / 60.0;
  make(slip_lines_figure(window, locked, options.slipping > 0.0 ? options.slipping : locked / 10.0),
       named(options.picture, "-lines"));
  const PictureOptions one = named(options.picture, "-event");
  const Figure figure =
      rupture_detail_figure(detail, event, options.p_speed, options.s_speed, lines);
  lines.write(one.output + "-lines.csv");
  make(figure, one);
}

void run(Options &options) {
  options.json.check(options.catalogues.paths);
  check(options.catalogues);
  std::vector<std::string> inputs = options.catalogues.paths;
  if (!options.history.empty()) inputs.push_back(options.history);
  std::vector<std::string> outputs;
  for (const char *const name :
       {"-spacetime", "-spacetime-outlines", "-lines", "-event", "-event-lines", "-lengths",
        "-moments", "-length", "-pe", "-stress"})
    for (const char *const kind : {".csv", ".gp", ".png", ".svg"})
      outputs.push_back(std::string(name) + kind);
  options.picture.check(inputs, outputs, {options.json.output()});
  if (options.history.empty() && options.event != 0)
    throw std::invalid_argument("--event needs --history");

  std::vector<RuptureTable> tables;
  Table largest_of({"label", "ruptures", "moment", "largest", "longest"});
  for (const std::string &path : options.catalogues.paths) {
    tables.push_back(load_ruptures(path, options.catalogues));
    state_repairs(tables.back().head);
    if (!options.catalogues.labels.empty())
      tables.back().head.label = options.catalogues.labels[tables.size() - 1];
    const RuptureTable &table = tables.back();
    double moment = 0.0, largest = 0.0, longest = 0.0;
    for (const Event &e : table.events) {
      moment += e.slip_moment;
      largest = std::max(largest, e.slip_moment);
      longest = std::max(longest, e.rupture_length);
    }
    fmt::print("{}: {} ruptures, moments in all {}, largest {}, longest {}\n", table.head.label,
               table.events.size(), short_number(moment, 6), short_number(largest),
               short_number(longest));
    largest_of.add(table.head.label).add(static_cast<std::int64_t>(table.events.size()));
    largest_of.add(moment).add(largest).add(longest).end_row();
  }
  // What cannot be drawn is found out before the first file is written.
  const std::vector<std::pair<std::string, Figure>> figures = {
      {"-lengths", rupture_density_figure(tables, RuptureQuantity::length)},
      {"-moments", rupture_density_figure(tables, RuptureQuantity::moment)},
      {"-length", moment_length_figure(tables)},
      {"-pe", moment_pe_figure(tables)},
      {"-stress", stress_drop_figure(tables)}};
  if (!options.history.empty()) draw_history(options, tables.front());
  options.json.add("catalogues", largest_of);
  for (const auto &[name, figure] : figures) {
    make(figure, named(options.picture, name));
    options.json.add(name.substr(1), figure.table);
  }
  options.json.write();
}

}  // namespace

void add_rupture(CLI::App &app) {
  CLI::App *command = app.add_subcommand(
      "rupture",
      "Draws the ruptures of faults (ours; catalogues of compute lsm/events with events ruptures): "
      "how many of each length (BASE-lengths) and moment (BASE-moments) there are, moment against "
      "length (BASE-length), against the drop of the total PE, which the paper says "
      "should be proportional (BASE-pe), stress drop against moment (BASE-stress). With a slip "
      "history, also the slip velocity in space and time with the ruptures outlined "
      "(BASE-spacetime), lines of the slip along the fault (BASE-lines), and one rupture in detail "
      "(BASE-event)");
  auto options = std::make_shared<Options>();
  options->catalogues.add_to(command);
  options->json.add_to(command);
  add_picture_options(command, options->picture, "rupture");
  const std::string group = "Slip history";
  command
      ->add_option("--history", options->history,
                   "Slip history of the first catalogue's run; --from and --to choose its part")
      ->type_name("FILE")
      ->default_str("none")
      ->group(group);
  command->add_option("--event", options->event, "event_id of the rupture that is drawn in detail")
      ->default_str("that of the largest moment")
      ->group(group);
  command
      ->add_option("--locked", options->locked,
                   "Time between two lines of slip while the fault is locked (model time)")
      ->check(CLI::PositiveNumber)
      ->default_str("a 60th of the time drawn")
      ->group(group);
  command
      ->add_option("--slipping", options->slipping,
                   "Time between two lines of slip while anything slips (model time)")
      ->check(CLI::PositiveNumber)
      ->default_str("a tenth of --locked")
      ->group(group);
  add_wave_speeds(command, options->p_speed, options->s_speed, group);
  command->callback([options] { run(*options); });
}

}  // namespace LSM::postproc
