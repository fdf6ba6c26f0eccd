// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_kind.h
/// Kinds of events and their finders. A kind is a class: its name after the keyword `events`, its
/// own keywords, what it needs recorded, what it adds to headers, and its finder. event_kinds.h
/// lists all of them; nothing else distinguishes them.
#ifndef LSM_EVENT_KIND_H
#define LSM_EVENT_KIND_H

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "events/event_picker.h"
#include "events/event_settings.h"
#include "events/fault_grid.h"
#include "events/slip_recorder.h"
#include "files/catalogue.h"
#include "files/keywords.h"
#include "files/text.h"

namespace LSM {

/// State of the fault at the end of an interval.
struct FaultMoment {
  std::int64_t intervals = 0;  ///< number of intervals so far
  double pe = 0.0;
  std::vector<float> stress;  ///< of the bins
};

/// The record of one step.
struct EventSample {
  std::int64_t step;
  double time, pe;
  const std::vector<BinSlip> *slips;  ///< of the step, if the kind asks for them; else null
  double x0, length;                  ///< begin and length of the fault
};

/// Finds events, on rank 0. It is given the samples of all steps and, if its kind asks for them,
/// the intervals of the fault. It reports events without an id, in order of their ends.
class EventFinder {
 public:
  using Report = std::function<void(const Event &)>;

  virtual ~EventFinder() = default;

  virtual void add_sample(const EventSample &, const Report &) {}
  /// Sets the state before the first interval: total PE and the stresses of the bins.
  virtual void begin(double /*pe*/, const FaultRow &) {}
  /// Adds the next interval, with PE at its end.
  virtual void add(double /*pe*/, const FaultRow &, const Report &) {}
  /// Reports open events as if they ended now.
  virtual void each_open_as_ended(const Report &) const {}

  /// Accounts for a change of PE between two runs that is not due to the model.
  virtual void leave_out_jump(double) {}
  /// Changes the settings of the picker. The ratio is that of the new time step to the old one.
  virtual void change_picker(const PickerSettings &, double /*ratio*/) {}

  virtual std::int64_t open() const = 0;
  /// Whether something slips, so that the slip history gives the last interval a record of its own.
  virtual bool active() const { return open() > 0; }
  virtual FaultMoment last_interval() const { return {}; }
  /// Step up to which the ends of events are known after the given step.
  virtual std::int64_t known_until(std::int64_t step) const = 0;

  /// State for restarts; set_state() throws std::invalid_argument if no such finder can have it.
  virtual std::vector<double> state() const = 0;
  virtual void set_state(const std::vector<double> &) = 0;
};

/// Adds a parameter to a header.
using AddParameter = std::function<void(const std::string &key, const std::string &value)>;

/// A kind of events.
class EventKind {
 public:
  virtual ~EventKind() = default;

  virtual const char *name() const = 0;
  /// Keywords that only this kind has.
  virtual Keywords keywords() { return {}; }

  /// Whether it needs the slips of contacts in each step, which only a periodic fault has.
  virtual bool wants_slips() const { return false; }
  /// Whether its events are picked from PE, so that the header of the series states the picker's
  /// settings.
  virtual bool picks_pe() const { return false; }
  /// Whether it needs the fault in bins and intervals.
  virtual bool wants_intervals() const { return false; }
  /// The input that asks for these, for messages.
  virtual std::string asked_by() const { return std::string("events ") + name(); }

  /// Adds to the header of its catalogues what describes the events, including add_sizes(). The
  /// parameter `events`, with the name of the kind, states that events may overlap.
  /// \param slip_bin width of the bins of the grid
  virtual void describe(const EventSettings &, double slip_bin, const AddParameter &,
                        CatalogueInfo &) const = 0;
  /// Settings that define what slips and what is connected, for the slip history.
  virtual RuptureSettings rupture_settings(const EventSettings &, double /*dt*/) const {
    return {};
  }
  /// \throws std::invalid_argument for settings out of range
  virtual std::unique_ptr<EventFinder> finder(const EventSettings &, const FaultGrid &) const = 0;

 protected:
  /// Adds what defines the sizes of events and PE, for describe().
  static void add_sizes(const EventSettings &settings, const AddParameter &add) {
    add("min_size", text_io::number(settings.picker.min_size));
    add("tangential_energy", settings.tangential ? "yes" : "no");
  }
};

}  // namespace LSM

#endif
