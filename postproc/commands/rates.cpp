// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "command.h"
#include "rate_figure.h"

namespace LSM::postproc {

namespace {

class Rates : public Statistic {
  MagnitudeOptions magnitudes_;
  double bin_ = 0.0;

  const char *help() const override {
    return "Rate of events and of the energy or seismic moment that they release, over time †";
  }

  void add_options(CLI::App *command) override {
    add_usual(command, "rates");
    OptionGroup group(command, "Rates †");
    group.add("--bin", bin_,
              "Width of the bins (model time; seconds with --unit-length); 0: a hundredth of the "
              "longest catalogue",
              zero_or_more());
    magnitudes_.add_quantity_to(group);
  }

  /// Factors that convert times, and the energy or moment released, to their units.
  std::pair<double, double> factors(const EventTable &table) const {
    if (!magnitudes_.units.given()) return {1.0, 1.0};
    return {magnitudes_.units.units(table.path, table.info).time(),
            magnitudes_.si_unit(table.path, table.info)};
  }

  ReleaseNames names(const std::vector<EventTable> &tables) const {
    const bool si = magnitudes_.units.given();
    const std::string time = si ? "s" : tables.front().time_unit();
    const std::string released = magnitudes_.of_moment()
                                     ? si ? "moment rate (N m/s)" : "slip moment per model time"
                                 : si ? "energy rate (W)"
                                      : "sizes per " + time;
    return {fmt::format("time ({})", time), "events per " + time, released};
  }

  Results find() override {
    magnitudes_.check();
    if (magnitudes_.of_moment()) catalogues.details = CatalogueOptions::all_events;
    return Statistic::find();
  }

  Results of(const std::vector<EventTable> &tables) override {
    std::vector<std::vector<Release>> releases;
    double longest = 0.0;
    for (const EventTable &table : tables) {
      magnitudes_.require(table.path, table.info);
      const auto [second, unit] = factors(table);
      std::vector<Release> &events = releases.emplace_back();
      if (magnitudes_.of_moment())
        for (const Event &event : table.details)
          events.push_back({event.t_start * second, event.slip_moment * unit});
      else
        for (const EventSummary &event : table.events)
          events.push_back({event.t_start * second, event.size * unit});
      if (!events.empty()) longest = std::max(longest, events.back().time - events.front().time);
    }
    const double width = bin_ > 0.0 ? bin_ : longest > 0.0 ? longest / 100.0 : 1.0;
    std::vector<ReleaseCurve> curves;
    Table means(Columns{{"label", "catalogue"},
                        {"events", "events"},
                        {"span", "from first to last"},
                        {"bin", "bins of"},
                        {"mean_event_rate", "events per time"},
                        {"mean_release_rate", "released per time"},
                        {"highest_event_rate", "highest rate of events"}});
    for (std::size_t i = 0; i < tables.size(); ++i) {
      curves.push_back({tables[i].label, tables[i].info.model, rates_of(releases[i], width)});
      if (releases[i].empty()) continue;
      const double span = releases[i].back().time - releases[i].front().time;
      if (releases[i].size() > 1 && !(span > 0.0))
        throw DegenerateData(tables[i].path + ": all times are 0: the events start together");
      double released = 0.0, highest = 0.0;
      for (const ReleaseBin &bin : curves.back().bins) {
        released += bin.released;
        highest = std::max(highest, bin.event_rate());
      }
      means.row(tables[i].label, releases[i].size(), span, width,
                static_cast<double>(releases[i].size()) / span, released / span, highest);
    }
    Results results;
    const ReleaseNames in = names(tables);
    results.say(fmt::format("{}; {}\n", in.time, in.released));
    results.table("means", std::move(means));
    results.figure("rates", release_figure(curves, in));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_rates() { return std::make_shared<Rates>(); }

}  // namespace LSM::postproc
