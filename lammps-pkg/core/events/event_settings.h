// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_settings.h
/// Settings of a recorder of events, whatever their kind.
#ifndef LSM_EVENT_SETTINGS_H
#define LSM_EVENT_SETTINGS_H

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "events/event_picker.h"
#include "events/fault_grid.h"
#include "files/parameters.h"

namespace LSM {

class EventKind;

/// Groups of particles below and above the fault.
struct TwoSides {
  std::string lower, upper;
};

/// Settings of a recorder.
struct EventSettings {
  std::string name;  ///< of this recorder, for messages

  std::string catalogue_file, series_file, history_file;  ///< empty: not written
  int series_stride = 1;
  bool resume = false;     ///< continue existing files, after a restart
  bool overwrite = false;  ///< replace existing files

  std::shared_ptr<EventKind> kind;  ///< never empty, see make_event_kind()
  bool explicit_times = false;      ///< steps and time are not proportional
  PickerSettings picker;
  bool tangential = true;  ///< tangential springs count as PE
  double bin_width = 1.0;  ///< of the bins along the fault
  TwoSides sides, faces;   ///< whole blocks; the particles that border on the fault

  // For kinds that need the fault in intervals:
  double driving = 0.0;  ///< velocity that slip is compared with
  double forward = 1.0;  ///< direction of the upper side along x: 1 or -1
  int interval = 10;     ///< steps over which the slip of a bin is summed
  double modulus = 0.0;  ///< shear modulus
  int quiet = 100;       ///< intervals in one record of the history while nothing slips

  /// Further parameters for the headers, which replace those of the same name.
  text_io::Parameters parameters;

  /// Divides the fault into bins, and the time from a step on into intervals.
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

}  // namespace LSM

#endif
