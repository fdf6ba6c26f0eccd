// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion between events and columns, which tests write and compare.
#ifndef LSM_TEST_EVENT_TABLES_H
#define LSM_TEST_EVENT_TABLES_H

#include <vector>

#include "event_table.h"

namespace LSM::postproc {

/// \param ends empty: events without duration
inline std::vector<EventSummary> events_of(const std::vector<double> &starts,
                                           const std::vector<double> &sizes,
                                           const std::vector<double> &ends = {}) {
  std::vector<EventSummary> events(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    events[i].t_start = starts[i];
    events[i].t_end = ends.empty() ? starts[i] : ends[i];
    events[i].size = sizes[i];
  }
  return events;
}

inline std::vector<double> starts(const EventTable &t) { return column(t.events, &Event::t_start); }
inline std::vector<double> ends(const EventTable &t) { return column(t.events, &Event::t_end); }
inline std::vector<double> sizes(const EventTable &t) { return column(t.events, &Event::size); }

}  // namespace LSM::postproc

#endif
