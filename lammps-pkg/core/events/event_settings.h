// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_settings.h
/// Settings of the recorder of a lattice solid run.
#ifndef LSM_EVENT_SETTINGS_H
#define LSM_EVENT_SETTINGS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "events/event_filter.h"
#include "events/event_picker.h"
#include "files/fault_grid.h"
#include "files/parameters.h"

namespace LSM {

/// Groups of particles below and above the fault.
struct TwoSides {
  std::string lower, upper;
};

/// Events are drops of PE, in the catalogue, and ruptures, in a catalogue of their own.
struct EventSettings {
  std::string name;  ///< of this recorder, for messages

  /// Empty: not written.
  std::string catalogue_file, series_file, ruptures_file, history_file;
  int series_stride = 1;
  /// Headers state that a file was left out by name.
  bool no_series = false, no_history = false;
  bool resume = false;     ///< continue existing files, after a restart
  bool overwrite = false;  ///< replace existing files

  bool explicit_times = false;  ///< steps and time are not proportional
  bool tangential = true;       ///< tangential springs count as PE
  PickerSettings picker;
  FilterSettings drops;     ///< which drops of PE are written
  FilterSettings ruptures;  ///< which ruptures are written
  bool location = false;    ///< locate drops of PE even if nothing else needs the slip
  double fraction = 0.05;   ///< bins with at most this fraction of the largest slip did not rupture

  // The fault in bins and intervals:
  TwoSides sides, faces;   ///< whole blocks; the particles that border on the fault
  double bin_width = 1.0;  ///< of the bins along the fault
  int interval = 10;       ///< steps over which the slip of a bin is summed
  double modulus = 0.0;    ///< shear modulus
  double forward = 1.0;    ///< direction of the upper side along x: 1 or -1

  // What a rupture is:
  double driving = 0.0;   ///< velocity that slip is compared with
  double slipping = 5.0;  ///< multiple of the driving velocity above which a bin slips
  int gap = 1;            ///< bins that may lie between two that are connected
  double pause = 3.0;     ///< time over which slips are connected
  int quiet = 100;        ///< intervals in one record of the history while nothing slips

  /// Further parameters for the headers, which replace those of the same name.
  files::Parameters parameters;

  /// Whether ruptures are looked for; the slip history also has to know what slips.
  bool finds_ruptures() const { return !ruptures_file.empty() || !history_file.empty(); }
  /// Whether the slip of the faces is recorded. If so, drops of PE are located on a line.
  bool records_slip() const { return location || finds_ruptures(); }
  /// The keyword that asks for slip, for messages.
  const char *asked_by() const {
    return !ruptures_file.empty() ? "ruptures" : !history_file.empty() ? "history" : "location";
  }

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
  /// Divides a plane: the grid along strike, and bins along dip.
  FaultGrid plane(FaultGrid strike, double z0, double length) const {
    strike.plane = true;
    strike.rows = std::max(1, static_cast<int>(length / bin_width * (1.0 + 1e-12)));
    strike.z0 = z0;
    strike.height = length / strike.rows;
    return strike;
  }
  /// What slips and what is connected.
  RuptureSettings rupture_settings(double dt) const {
    RuptureSettings s;
    s.velocity = slipping * driving;
    s.gap = gap;
    s.memory =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(pause / (interval * dt))));
    s.modulus = modulus;
    return s;
  }
};

}  // namespace LSM

#endif
