// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_table.h"

#include <cmath>

#include <fmt/format.h>

#include "files/text.h"
#include "samples.h"

namespace LSM::postproc {

std::string EventTable::kind() const {
  const std::string *name = info.find("events");
  return name ? *name : "pe";
}

double EventTable::length() const {
  double value = 0.0;
  for (const char *key : {"length", "blocks"}) {
    const std::string *text = info.find(key);
    if (text && text::parse(*text, value) && value > 0.0) return value;
  }
  return NAN;
}

double EventTable::picker_memory() const {
  if (earthquakes() || info.overlapping()) return NAN;
  double dt = 0.0, lambda = 0.0, stride = 1.0;
  const std::string *const step = info.find("dt"), *const rate = info.find("lambda"),
                           *const every = info.find("stride"), *const reading = info.find("picker");
  if (!step || !text::parse(*step, dt) || !rate || !text::parse(*rate, lambda)) return NAN;
  if (every) text::parse(*every, stride);
  double left = lambda;  // factor of the average change after one more sample
  if (reading && *reading == "average")
    left = lambda / (1.0 + lambda);
  else if (reading && *reading != "exponential")
    return NAN;
  if (!(left > 0.0 && left < 1.0)) return NAN;
  return model_time * dt * stride / -std::log(left);
}

std::vector<double> column_from(const EventTable &table, double least,
                                double EventSummary::*number) {
  std::vector<double> out;
  for (const EventSummary &event : table.events)
    if (event.size >= least) out.push_back(event.*number);
  return out;
}

void expect_events(const std::vector<EventTable> &tables) {
  std::int64_t by_time = 0, by_size = 0;
  for (const EventTable &table : tables) {
    if (!table.events.empty()) return;
    by_time += table.left_out_time;
    by_size += table.left_out_small;
  }
  throw DegenerateData(
      fmt::format("{}: no events{}, nothing to draw: expected at least one", tables.front().path,
                  by_time + by_size == 0
                      ? ""
                      : fmt::format(" ({} left out by time, {} by size)", by_time, by_size)));
}

SmallestSize Threshold::of(const EventTable &table) const {
  SmallestSize smallest;
  if (given)
    smallest = {*given, "as given"};
  else if (table.earthquakes())
    smallest = {table.complete_from, "where " + table.label + " begins"};
  else if (table.completeness > paper_threshold)
    smallest = {table.completeness, "completeness in the header of " + table.completeness_path};
  if (table.complete_from > smallest.size)
    smallest = {table.complete_from, "where the catalogue begins"};
  return smallest;
}

}  // namespace LSM::postproc
