// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_kind.h
/// Kinds of events and their finders. A kind is a class: its name after the keyword `events`, its
/// own keywords, what it needs recorded, what it adds to headers, and its finder. event_kinds.h
/// lists all of them; nothing else distinguishes them.
///
/// Drops of PE, the paper's events, are found in every run: their picker has the rate of PE.
#ifndef LSM_EVENT_KIND_H
#define LSM_EVENT_KIND_H

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lsm_catalogue.h"
#include "lsm_event_picker.h"
#include "lsm_fault_grid.h"
#include "lsm_keywords.h"
#include "lsm_slip_recorder.h"
#include "lsm_text_io.h"

namespace LSM {

class EventKind;

struct EventSettings {
  std::string name;  ///< of this recorder, for messages

  std::string catalogue_file, series_file, history_file;  ///< empty: not written
  int series_stride = 1;
  bool resume = false;     ///< continue existing files, after a restart
  bool overwrite = false;  ///< replace existing files

  std::shared_ptr<EventKind> kind;  ///< never empty, see make_event_kind()
  bool own_times = false;           ///< steps and time are not proportional
  PickerSettings picker;
  bool tangential = true;  ///< tangential springs count as PE
  double bin_width = 1.0;  ///< of the bins along the fault

  // Of the fault in intervals, for kinds that ask for it:
  double driving = 0.0;  ///< velocity that slip is compared with
  double forward = 1.0;  ///< direction of the upper side along x: 1 or -1
  int interval = 10;     ///< steps over which the slip of a bin is summed
  double modulus = 0.0;  ///< shear modulus
  int quiet = 100;       ///< intervals in one record of the history while nothing slips

  /// For the headers; they replace those of the same name.
  text_io::Parameters parameters;

  /// The fault from a step on.
  FaultGrid grid(double x0, double length, std::int64_t step, double time, double dt) const {
    FaultGrid g;
    g.bins = std::max(1, static_cast<int>(length / bin_width * (1.0 + 1e-12)));
    g.x0 = x0;
    g.width = length / g.bins;
    g.step0 = step;
    g.interval = interval;
    g.time0 = time;
    g.dt = dt;
    return g;
  }
};

/// The fault at the end of an interval.
struct FaultMoment {
  std::int64_t intervals = 0;  ///< so far
  double pe = 0.0;
  std::vector<float> stress;  ///< of the bins
};

/// What is recorded in a step.
struct EventSample {
  std::int64_t step;
  double time, pe;
  const std::vector<BinSlip> *slips;  ///< of the step, if the kind asks for them; else null
  double x0, length;                  ///< begin and length of the fault
};

/// Finds events in the record, on the rank that has all of it. Reported events need no id; they
/// must be in order of their ends. It is given the samples of all steps and, if its kind asks for
/// them, the intervals of the fault.
class EventFinder {
 public:
  using Report = std::function<void(const Event &)>;

  virtual ~EventFinder() = default;

  virtual void add_sample(const EventSample &, const Report &) {}
  /// The state before the first interval: total PE and the stresses of the bins.
  virtual void begin(double /*pe*/, const FaultRow &) {}
  /// The next interval, with PE at its end.
  virtual void add(double /*pe*/, const FaultRow &, const Report &) {}
  /// Reports open events as if they ended now.
  virtual void each_open_as_ended(const Report &) const {}

  virtual std::int64_t open() const = 0;
  /// Something slips, so that the slip history gives the last interval a record of its own.
  virtual bool active() const { return open() > 0; }
  virtual FaultMoment last_interval() const { return {}; }
  /// Step up to which the ends of events are known at the end of the given one.
  virtual std::int64_t known_until(std::int64_t step) const = 0;

  /// For restarts. \throws std::invalid_argument for numbers that cannot be those of such a finder
  virtual std::vector<double> state() const = 0;
  virtual void set_state(const std::vector<double> &) = 0;
};

/// Puts a parameter into a header.
using AddParameter = std::function<void(const std::string &key, const std::string &value)>;

class EventKind {
 public:
  virtual ~EventKind() = default;

  virtual const char *name() const = 0;
  /// Its own keywords.
  virtual Keywords keywords() { return {}; }

  /// Whether it needs the slips of contacts in each step, which a periodic fault has.
  virtual bool wants_slips() const { return false; }
  /// Whether it needs the fault in bins and intervals.
  virtual bool wants_intervals() const { return false; }
  /// The input that asks for these, for messages.
  virtual std::string asked_by() const { return std::string("events ") + name(); }

  /// What the header of its catalogues has in addition. The parameter `events`, with its name, says
  /// that events may overlap. slip_bin: width of the bins of the grid.
  virtual void describe(const EventSettings &, double slip_bin, const AddParameter &,
                        CatalogueInfo &) const = 0;
  /// What slips and what is connected, for the slip history.
  virtual RuptureSettings rupture_settings(const EventSettings &, double /*dt*/) const {
    return {};
  }
  /// Null if events are the drops of PE, which are found in any case.
  /// \throws std::invalid_argument for settings out of range
  virtual std::unique_ptr<EventFinder> finder(const EventSettings &, const FaultGrid &) const = 0;
};

}  // namespace LSM

#endif
