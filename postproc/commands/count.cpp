// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "command.h"

namespace LSM::postproc {

namespace {

/// Counts events while reading, so that catalogues may have any number of them.
class Count : public CatalogueAnalysis {
  std::vector<double> sizes_ = {1e-4, 1e-3, 1e-2, 1e-1};
  std::int64_t brief_ = 0;

  /// Counts of the events of one catalogue from a size on.
  struct From {
    double size = 0.0;
    std::int64_t events = 0, brief = 0;
    double released = 0.0;
  };

  const char *help() const override {
    return "Number of events above several sizes, the total energy that they release, and the "
           "fraction of time within events †";
  }

  void add_options(CLI::App *command) override {
    add_catalogues(command, catalogues);
    add_displacement(command, catalogues);
    json.add_to(command);
    OptionGroup group(command);
    group.add("--size", sizes_, "Smallest size (model energy), several allowed", one_each(),
              size_or_magnitude(), zero_or_more());
    group.add("--brief", brief_,
              "Also count events of at most this many steps; at too large time steps there are "
              "bursts of them",
              zero_or_more());
  }

  Results find() override {
    std::sort(sizes_.begin(), sizes_.end());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    struct Total {
      std::string label;
      std::int64_t events = 0, last_step = 0;
      double first = nan, last = nan, end = nan, largest = nan, share = nan;
    };
    TableOf<Total> totals;
    totals.column("label", "catalogue", &Total::label);
    totals.column("events", "events", &Total::events);
    totals.show("share of the time within events", &Total::share);
    totals.data("first_start", &Total::first);
    totals.data("last_start", &Total::last);
    totals.data("last_end", &Total::end);
    totals.column("last_step", "last step", &Total::last_step);
    totals.column("largest", "largest", &Total::largest);
    totals.data("share_in_events", &Total::share);
    Table sizes(Columns{{"label", "catalogue"},
                        {"size", "from size"},
                        {"events", "events"},
                        {"brief", {}},
                        {"released", "sizes in all"},
                        {"mean_time", "mean time"}});
    std::size_t number = 0;
    for_each_catalogue(catalogues, [&](const std::string &path, const CatalogueOptions &one) {
      std::vector<From> counts;
      for (const double size : sizes_) counts.push_back({size});
      Total all;
      const EventTable table = read_events(path, one, [&](const Event &event) {
        ++all.events;  // ruptures are in the order of their ends
        all.first = std::fmin(all.first, event.t_start);
        all.last = std::fmax(all.last, event.t_start);
        all.last_step = event.step_end;
        all.largest = std::fmax(all.largest, event.size);
        for (From &from : counts) {
          if (event.size < from.size) break;
          ++from.events;
          from.brief += event.step_end - event.step_start <= brief_;
          from.released += event.size;
        }
      });
      state_repairs(table);
      all.label = number < catalogues.labels.size() ? catalogues.labels[number] : table.label;
      ++number;
      const double span = table.last_end - all.first;
      all.end = table.last_end;
      all.share = table.info.overlapping() ? nan : table.in_events / span;
      totals.row(all);
      for (const From &from : counts) {
        const double mean = from.events > 0 ? span / static_cast<double>(from.events) : nan;
        sizes.row(all.label, from.size, from.events, from.brief, from.released, mean);
      }
      return table.earthquakes();
    });
    Results results;
    results.table("catalogues", std::move(totals));
    results.table("sizes", std::move(sizes));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_count() { return std::make_shared<Count>(); }

}  // namespace LSM::postproc
