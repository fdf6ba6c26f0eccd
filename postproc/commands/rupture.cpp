// SPDX-License-Identifier: GPL-2.0-or-later
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "input_file.h"
#include "run_files.h"
#include "rupture_figures.h"

namespace LSM::postproc {

namespace {

/// Reads a catalogue of ruptures.
/// \throws FileError
/// \throws std::runtime_error unless it is a catalogue of ruptures of a fault
EventTable load_ruptures(const std::string &path, const CatalogueOptions &options) {
  EventTable table = read_all(path, options);
  const CatalogueInfo &info = table.info;
  if (info.model != "lsm" || !info.overlapping() || !info.slip_moment || !info.rupture_length ||
      !info.x_hypocentre || !info.stress_drop)
    throw std::runtime_error(path +
                             ": no catalogue of ruptures of a fault, expected one of compute "
                             "lsm/events with ruptures");
  return table;
}

const Event &largest_in(const std::vector<Event> &events, const std::string &path) {
  if (events.empty()) throw std::runtime_error(path + ": no events, expected at least one");
  return *std::max_element(events.begin(), events.end(), [](const Event &a, const Event &b) {
    return a.slip_moment < b.slip_moment;
  });
}

Figure densities(const std::vector<EventTable> &tables, RuptureQuantity quantity) {
  std::vector<RuptureDensity> all;
  for (const EventTable &table : tables)
    all.push_back({table.label, table.length(), rupture_densities(table, quantity)});
  const double limit =
      quantity == RuptureQuantity::moment ? smallest_moment(tables.front().info) : 0.0;
  return rupture_density_figure(all, quantity, limit);
}

class Rupture : public CatalogueAnalysis {
  std::string history_;
  double p_speed_ = 2.12, s_speed_ = 1.22, arrival_ = 0.0;

  const char *help() const override {
    return "Draws the ruptures of faults † (catalogues of compute lsm/events with "
           "ruptures): their numbers by length (BASE-lengths) and moment (BASE-moments), moment "
           "against length (BASE-length), drop of the total PE, which the paper expects to be "
           "proportional, against moment (BASE-pe), stress drop against moment (BASE-stress). "
           "With a slip history, also the slip velocity in space and time with the ruptures "
           "outlined (BASE-spacetime), lines of the slip along the fault (BASE-lines), and the "
           "rupture of the largest moment in detail (BASE-event). With the history of a plane: maps "
           "of that rupture, of its slip (BASE-slip), the time at which it came (BASE-time) and its "
           "largest slip velocity (BASE-rate), and its moment rate (BASE-momentrate)";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    catalogues.details = CatalogueOptions::all_events;
    json.add_to(command);
    add_picture(command, "rupture");
    OptionGroup group(command, "Slip history");
    group.add("--history", history_,
              "Slip history of the first catalogue's run; --from and --to select a part",
              kind("FILE"), shown("none"));
    add_wave_speeds(group, p_speed_, s_speed_);
    group.add(
        "--arrival", arrival_,
        "Slip velocity above which the rupture has come to a place of a plane, for the map of "
        "times",
        positive(), shown("that above which places slip"));
  }

  std::vector<std::string> inputs() const override {
    std::vector<std::string> inputs = catalogues.paths;
    if (!history_.empty()) inputs.push_back(history_);
    return inputs;
  }
  std::vector<std::string> endings() const override {
    return picture_files({"-spacetime", "-spacetime-outlines", "-lines", "-event", "-event-lines",
                          "-slip", "-time", "-time-contours", "-rate", "-momentrate", "-lengths",
                          "-moments", "-length", "-pe", "-stress"});
  }

  /// Returns whether it is that of a plane.
  bool draw_history(const EventTable &catalogue, Results &results) const {
    SlipHistoryReader history = open_history(history_, catalogues.lenient);
    check_same_run(header_of(catalogue), {history_, history.info().header()});
    const bool plane = history.info().grid.plane;
    if (plane != catalogue.info.plane)
      throw std::runtime_error(fmt::format(
          "{}: ruptures {}, expected its slip history, found that of a {}", catalogue.path,
          plane ? "along a line" : "on a plane", plane ? "plane" : "line"));
    if (plane)
      draw_maps(catalogue, history, results);
    else
      draw_line(catalogue, history, results);
    return plane;
  }

  void draw_maps(const EventTable &catalogue, SlipHistoryReader &history, Results &results) const {
    std::vector<Event> inside;
    for (const Event &e : catalogue.details)
      if (e.t_start >= catalogues.from_time && e.t_end <= catalogues.to_time) inside.push_back(e);
    const Event event = largest_in(inside, catalogue.path);
    const SlipMap map = with_path(history_, [&] {
      return slip_map(history, event, arrival_ > 0.0 ? arrival_ : history.info().ruptures.velocity);
    });
    Table lines("time,x1,z1,x2,z2");
    Figure time = rupture_time_figure(map, event, lines);
    results.figure("", slip_map_figure(map, event), "-slip");
    results.table("", std::move(lines), "-time-contours");
    results.figure("", std::move(time), "-time");
    results.figure("", slip_rate_figure(map, event), "-rate");
    results.figure("", moment_rate_figure(map, event), "-momentrate");
  }

  void draw_line(const EventTable &catalogue, SlipHistoryReader &history, Results &results) const {
    std::vector<SlipRecord> records;
    for (SlipRecord record; history.next(record);) records.push_back(record);
    const auto between = [&](double from, double to) {
      return with_path(history_, [&] { return history_window(history.info(), records, from, to); });
    };
    const HistoryWindow window = between(catalogues.from_time, catalogues.to_time);
    std::vector<Event> inside;
    for (const Event &e : catalogue.details)
      if (e.t_start >= window.from && e.t_end <= window.to) inside.push_back(e);
    const Event event = largest_in(inside, catalogue.path);
    const double room = 0.15 * (event.t_end - event.t_start);
    const HistoryWindow detail = between(event.t_start - room, event.t_end + room);

    Table outlines("curve,x,y"), lines = outlines;
    Figure space_time = space_time_figure(window, outlines);
    results.table("", std::move(outlines), "-spacetime-outlines");
    results.figure("", std::move(space_time), "-spacetime");
    const double locked = (window.to - window.from) / 60.0;
    results.figure("", slip_lines_figure(window, locked, locked / 10.0), "-lines");
    Figure figure = rupture_detail_figure(detail, event, p_speed_, s_speed_, lines);
    results.table("", std::move(lines), "-event-lines");
    results.figure("", std::move(figure), "-event");
  }

  Results find() override {
    Results results;
    std::vector<EventTable> tables;
    Table largest_of(Columns{{"label", "catalogue"},
                             {"ruptures", "ruptures"},
                             {"moment", "moments in all", 6},
                             {"largest", "largest"},
                             {"longest", "longest"}});
    for_each_catalogue(catalogues, [&](const std::string &path, const CatalogueOptions &one) {
      EventTable table = load_ruptures(path, one);
      state_repairs(table);
      if (!catalogues.labels.empty()) table.label = catalogues.labels[tables.size()];
      double moment = 0.0, largest = 0.0, longest = 0.0;
      for (const Event &e : table.details) {
        moment += e.slip_moment;
        largest = std::max(largest, e.slip_moment);
        longest = std::max(longest, e.rupture_length);
      }
      largest_of.row(table.label, table.details.size(), moment, largest, longest);
      tables.push_back(std::move(table));
      return false;
    });
    results.table("catalogues", std::move(largest_of));
    const bool plane = !history_.empty() && draw_history(tables.front(), results);
    try {
      add_statistics(tables, results);
    } catch (const DegenerateData &error) {
      // A rupture of a plane is often the only one of its run.
      if (!plane) throw;
      results.say(fmt::format("no figures of all ruptures: {}\n", error.what()));
    }
    return results;
  }

  static void add_statistics(const std::vector<EventTable> &tables, Results &results) {
    const RuptureRelations relations = rupture_relations(tables);
    results.figure("lengths", densities(tables, RuptureQuantity::length), "-lengths");
    results.figure("moments", densities(tables, RuptureQuantity::moment), "-moments");
    results.figure("length", moment_length_figure(relations), "-length");
    results.figure("pe", moment_pe_figure(relations), "-pe");
    results.figure("stress", stress_drop_figure(relations), "-stress");
  }
};

}  // namespace

std::shared_ptr<Command> make_rupture() { return std::make_shared<Rupture>(); }

}  // namespace LSM::postproc
