// SPDX-License-Identifier: GPL-2.0-or-later
#include "regime_table.h"

#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

void SeriesRegime::take(const RegimeMeter &meter) {
  try {
    regime = meter.result();
  } catch (const std::runtime_error &error) {
    why = error.what();
  }
}

Table regime_table(const std::vector<SeriesRegime> &series) {
  Table table(
      "samples,events,regime,saw_tooth,stick_slip_above,drop_over_load,"
      "time_in_events,mean_duration,why,!path,!model,!length,!times");
  table.show({{"PE series", "path"},
              {"model", "model"},
              {"length or blocks", "length", 6},
              {"times", "times"},
              {"samples", "samples"},
              {"events", "events"},
              {"regime", "regime"},
              {"saw-tooth", "saw_tooth"},
              {"stick-slip above", "stick_slip_above", 3},
              {"fastest fall / load", "drop_over_load"},
              {"share of the time within events", "time_in_events"},
              {"mean duration of events (model time)", "mean_duration"},
              {"degenerate", "why"}});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SeriesRegime &one : series) {
    table.add(one.samples).add(one.events);
    if (const auto &r = one.regime)
      table.add(name_of(*r))
          .add(r->saw_tooth)
          .add(r->above)
          .add(r->drop_over_load)
          .add(r->time_in_events)
          .add(r->mean_duration);
    else
      table.add("").add(nan).add(nan).add(nan).add(nan).add(nan);
    table.row(one.why, one.path, model_name(one.model), one.length,
              fmt::format("{} to {}", short_number(one.first, 6), short_number(one.last, 6)));
  }
  return table;
}

}  // namespace LSM::postproc
