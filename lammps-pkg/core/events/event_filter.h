// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_filter.h
/// Decides which events are written, numbers them, and counts those that are left out.
#ifndef LSM_EVENT_FILTER_H
#define LSM_EVENT_FILTER_H

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "files/event.h"

namespace LSM {

struct FilterSettings {
  double min_size = 0.0;          ///< positive sizes below this are left out (*)
  bool keep_nonpositive = false;  ///< events of size <= 0 are written too, whatever min_size is (*)
  /// Events that start before this time are left out.
  double warmup = -std::numeric_limits<double>::infinity();
};

struct FilterCounts {
  std::int64_t events = 0;                                                     ///< written
  std::int64_t dropped_nonpositive = 0, dropped_small = 0, before_warmup = 0;  ///< left out
  double last_size = 0.0;  ///< size of the last event written

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.events, self.dropped_nonpositive, self.dropped_small, self.before_warmup,
          self.last_size);
  }
};

/// All programs use this one, for all kinds of events.
class EventFilter {
 public:
  /// \throws std::invalid_argument if a setting is out of range.
  explicit EventFilter(const FilterSettings &settings = {}) : settings_(settings) {
    if (!std::isfinite(settings_.min_size) || settings_.min_size < 0.0)
      throw std::invalid_argument("minimum size of events must be a finite number >= 0");
  }

  /// Whether an event is to be written; counts it if not.
  bool passes(const EventSummary &event) {
    std::int64_t FilterCounts::*out = nullptr;
    if (!(event.size > 0.0)) {
      if (!settings_.keep_nonpositive) out = &FilterCounts::dropped_nonpositive;
    } else if (event.size < settings_.min_size) {
      out = &FilterCounts::dropped_small;
    }
    if (!out && event.t_start < settings_.warmup) out = &FilterCounts::before_warmup;
    if (out) ++(counts_.*out);
    return !out;
  }
  /// Gives an event that is written the next number.
  void number(Event &event) {
    event.id = ++counts_.events;
    counts_.last_size = event.size;
  }

  const FilterSettings &settings() const { return settings_; }
  const FilterCounts &counts() const { return counts_; }
  void set_counts(const FilterCounts &counts) { counts_ = counts; }

 private:
  FilterSettings settings_;
  FilterCounts counts_;
};

}  // namespace LSM

#endif
