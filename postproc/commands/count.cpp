// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "command.h"

namespace LSM::postproc {

namespace {

/// Reads catalogues event by event: of all commands this one is for any number of events.
class Count : public CatalogueAnalysis {
  std::vector<double> sizes_ = {1e-4, 1e-3, 1e-2, 1e-1};
  std::int64_t brief_ = 0;

  /// Events of one catalogue from a size on.
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
    catalogues.add_to(command);
    catalogues.add_displacement(command);
    json.add_to(command);
    OptionGroup group(command);
    group.add("--size", sizes_, "Smallest size (model energy), several allowed", one_each(),
              size_or_magnitude(), zero_or_more());
    group.add("--brief", brief_,
              "Also count events of at most this many steps; at too large time steps there are "
              "bursts of them",
              zero_or_more());
  }

  Findings find() override {
    std::sort(sizes_.begin(), sizes_.end());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Table totals(
        "label,events,first_start,last_start,last_end,last_step,largest,"
        "share_in_events");
    Table sizes("label,size,events,brief,released,mean_time");
    totals.show({{"catalogue", "label"},
                 {"events", "events"},
                 {"share of the time within events", "share_in_events"},
                 {"last step", "last_step"},
                 {"largest", "largest"}});
    sizes.show({{"catalogue", "label"},
                {"from size", "size"},
                {"events", "events"},
                {"sizes in all", "released"},
                {"mean time", "mean_time"}});
    std::size_t number = 0;
    for_each_catalogue(catalogues, [&](const std::string &path, const CatalogueOptions &one) {
      std::vector<From> counts;
      for (const double size : sizes_) counts.push_back({size});
      std::int64_t events = 0, last_step = 0;
      double first = nan, last = nan, largest = nan;
      const EventTable table = read_events(path, one, [&](const Event &event) {
        if (events++ == 0) first = event.t_start;
        last = event.t_start;
        last_step = event.step_end;
        largest = std::fmax(largest, event.size);
        for (From &from : counts) {
          if (event.size < from.size) break;
          ++from.events;
          from.brief += event.step_end - event.step_start <= brief_;
          from.released += event.size;
        }
      });
      state_repairs(table);
      const std::string label =
          number < catalogues.labels.size() ? catalogues.labels[number] : table.label;
      ++number;
      const double span = table.last_end - first;
      const double share = table.info.overlapping() ? nan : table.in_events / span;
      totals.row(label, events, first, last, table.last_end, last_step, largest, share);
      for (const From &from : counts) {
        const double mean = from.events > 0 ? span / static_cast<double>(from.events) : nan;
        sizes.row(label, from.size, from.events, from.brief, from.released, mean);
      }
      return table.earthquakes();
    });
    Findings found;
    found.table("catalogues", std::move(totals));
    found.table("sizes", std::move(sizes));
    return found;
  }
};

}  // namespace

std::shared_ptr<Command> make_count() { return std::make_shared<Count>(); }

}  // namespace LSM::postproc
