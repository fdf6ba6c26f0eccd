// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_matching.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace LSM::postproc {

namespace {

constexpr int shifts = 7;

struct Start {
  double time, log_size;
};

std::vector<Start> starts_of(const EventTable &table, double least_size, double from, double to) {
  std::vector<Start> out;
  for (const EventSummary &event : table.events)
    if (event.size >= least_size && event.t_start >= from && event.t_start < to)
      out.push_back({event.t_start, std::log(event.size)});
  return out;
}

std::int64_t count_matches(const std::vector<Start> &first, const std::vector<Start> &second,
                           const MatchRule &rule) {
  std::vector<bool> taken(second.size(), false);
  std::int64_t found = 0;
  for (const Start &event : first) {
    auto near = std::lower_bound(second.begin(), second.end(), event.time - rule.within,
                                 [](const Start &a, double time) { return a.time < time; });
    double least = rule.within;
    auto best = second.end();
    for (; near != second.end() && near->time < event.time + rule.within; ++near) {
      const double apart = std::fabs(near->time - event.time);
      if (apart < least && !taken[static_cast<std::size_t>(near - second.begin())] &&
          std::fabs(near->log_size - event.log_size) < std::log(2.0)) {
        least = apart;
        best = near;
      }
    }
    if (best == second.end()) continue;
    taken[static_cast<std::size_t>(best - second.begin())] = true;
    ++found;
  }
  return found;
}

}  // namespace

EventMatches match_events(const EventTable &first, const EventTable &second,
                          const MatchRule &rule) {
  if (first.events.empty() || second.events.empty())
    throw std::invalid_argument("matching: a catalogue without events");
  const double from = std::max(first.events.front().t_start, second.events.front().t_start);
  const double to = std::min(first.last_end, second.last_end);
  if (!(to > from)) throw std::invalid_argument("matching: catalogues have no time in common");
  const std::vector<Start> one = starts_of(first, rule.least_size, from, to);
  const std::vector<Start> other = starts_of(second, rule.least_size, from, to);
  EventMatches matches{static_cast<std::int64_t>(one.size()),
                       static_cast<std::int64_t>(other.size()), count_matches(one, other, rule),
                       0.0};
  for (int k = 1; k <= shifts; ++k) {
    const double shift = (to - from) * k / (shifts + 1);
    std::vector<Start> shifted = one;
    for (Start &event : shifted) {
      event.time += shift;
      if (event.time >= to) event.time -= to - from;
    }
    std::sort(shifted.begin(), shifted.end(),
              [](const Start &a, const Start &b) { return a.time < b.time; });
    matches.chance += static_cast<double>(count_matches(shifted, other, rule)) / shifts;
  }
  return matches;
}

}  // namespace LSM::postproc
