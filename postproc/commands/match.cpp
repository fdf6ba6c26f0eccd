// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "command.h"
#include "event_matching.h"

namespace LSM::postproc {

namespace {

/// Shifts the times of a catalogue so that they count from the origin, which is a model time even
/// if the times are displacements of the plates.
void count_from(EventTable &table, double origin, bool displacement) {
  double velocity = 1.0;
  if (displacement) text_io::parse(*table.info.find("velocity"), velocity);
  const double shift = origin * std::fabs(velocity);
  for (EventSummary &event : table.events) {
    event.t_start -= shift;
    event.t_end -= shift;
  }
  table.last_end -= shift;
}

class Match : public Statistic {
  MatchRule rule_;
  double origin_ = 0.0;

  const char *help() const override {
    return "How many events of the first catalogue are found in each of the others, with about "
           "the same start and size, each counted once; and how many are found by chance, with "
           "the first catalogue shifted in time †";
  }

  void add_options(CLI::App *command) override {
    catalogues.add_to(command);
    catalogues.add_displacement(command);
    json.add_to(command);
    OptionGroup group(command);
    group.add("--threshold", rule_.least_size, "Smallest size of the events (model energy)",
              size_or_magnitude(), zero_or_more(), positive(), shown(""), required());
    group.add("--within", rule_.within,
              "Starts of the same event differ by less than this (model time, or displacement)",
              positive(), required());
    group.add("--origin", origin_,
              "Model time subtracted from the times of both, e.g. that at which the plates begin "
              "to move",
              zero_or_more());
  }

  Results of(const std::vector<EventTable> &tables) override {
    if (tables.size() < 2)
      throw std::invalid_argument("one catalogue, expected at least two to compare");
    Results results;
    Table out(Columns{{"first", "first"},
                      {"second", "second"},
                      {"smallest_size", "smallest size"},
                      {"n_first", "events"},
                      {"n_second", "in the second"},
                      {"same", "in both"},
                      {"chance", "by chance"}});
    EventTable first = tables.front();
    count_from(first, origin_, catalogues.displacement);
    for (std::size_t i = 1; i < tables.size(); ++i) {
      EventTable second = tables[i];
      count_from(second, origin_, catalogues.displacement);
      EventMatches m;
      try {
        m = match_events(first, second, rule_);
      } catch (const std::invalid_argument &e) {
        throw std::runtime_error(fmt::format("{} and {}: {}", first.path, second.path, e.what()));
      }
      out.row(first.label, second.label, rule_.least_size, m.first, m.second, m.same, m.chance);
    }
    results.table("matches", std::move(out));
    return results;
  }
};

}  // namespace

std::shared_ptr<Command> make_match() { return std::make_shared<Match>(); }

}  // namespace LSM::postproc
