// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_table.h"

#include <cmath>

#include "lsm_text_io.h"

namespace LSM::postproc {

std::string EventTable::kind() const {
  const std::string *name = info.find("events");
  return name ? *name : "pe";
}

double EventTable::length() const {
  double value = 0.0;
  for (const char *key : {"length", "blocks"}) {
    const std::string *text = info.find(key);
    if (text && text_io::parse(*text, value) && value > 0.0) return value;
  }
  return NAN;
}

double EventTable::share_in_events() const {
  if (events.empty() || info.overlapping()) return NAN;
  return in_events / (last_end - events.front().t_start);
}

std::vector<double> column_from(const EventTable &table, double least, double Shock::*number) {
  std::vector<double> out;
  for (const Shock &event : table.events)
    if (event.size >= least) out.push_back(event.*number);
  return out;
}

std::int64_t events_from(const EventTable &table, double least) {
  return std::count_if(table.events.begin(), table.events.end(),
                       [least](const Shock &event) { return event.size >= least; });
}

SmallestSize Threshold::in(const EventTable &table) const {
  if (given_) return {size_, SmallestSize::Origin::given};
  if (table.earthquakes())
    return {table.complete_from, SmallestSize::Origin::catalogue, table.label};
  if (table.completeness > size_)
    return {table.completeness, SmallestSize::Origin::header, table.completeness_path};
  return {size_, SmallestSize::Origin::paper};
}

SmallestSize Threshold::complete_in(const EventTable &table) const {
  const SmallestSize smallest = in(table);
  if (!(table.complete_from > smallest.size)) return smallest;
  return {table.complete_from, SmallestSize::Origin::catalogue};
}

}  // namespace LSM::postproc
