// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_event_settings.h
/// What a lattice solid run records about its events, and the headers of the files that follow.
#ifndef LSM_EVENT_SETTINGS_H
#define LSM_EVENT_SETTINGS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "lsm_catalogue.h"
#include "lsm_event_picker.h"
#include "lsm_pe_series.h"
#include "lsm_ruptures.h"
#include "lsm_slip_history.h"
#include "lsm_text_io.h"

namespace LSM {

struct EventSettings {
  std::string name;  ///< of this recorder, for messages

  std::string catalogue_file, series_file, history_file;  ///< empty: not written
  bool series_binary = true;
  int series_stride = 1;
  bool resume = false;     ///< go on with files that exist, from a restart
  bool overwrite = false;  ///< replace files that exist

  bool ruptures = false;   ///< events are ruptures, not drops of PE
  bool own_times = false;  ///< steps and time are not proportional
  PickerSettings picker;
  bool tangential = true;      ///< tangential springs count as PE
  bool location = false;       ///< slip moment, centroid and rupture length of each event
  double bin_width = 1.0;      ///< of the bins along the fault
  double bin_fraction = 0.05;  ///< bins with at most this part of the largest slip are not ruptured

  // Of ruptures:
  double slipping = 5.0;  ///< multiple of the driving velocity above which a bin slips
  double driving = 0.0;   ///< velocity that slip counts against
  double forward = 1.0;   ///< direction of the upper side along x: 1 or -1
  int interval = 10;      ///< steps over which the slip of a bin is taken together
  int gap = 1;            ///< bins that may lie between two that are connected
  double pause = 3.0;     ///< time over which slips are connected
  double modulus = 0.0;   ///< shear modulus
  int quiet = 100;        ///< intervals in one record of the history while nothing slips

  /// For the headers; they take the place of ours of the same name.
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

  RuptureSettings rupture_settings(double dt) const {
    RuptureSettings settings;
    settings.velocity = slipping * driving;
    settings.gap = gap;
    settings.memory =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::llround(pause / (interval * dt))));
    settings.modulus = modulus;
    return settings;
  }
};

/// What the headers say about the scene.
struct SceneInfo {
  text_io::Parameters parameters;  ///< in the order of the file
  int ranks = 1;
  double dt = 1.0;
};

/// The times of steps: a restart file holds these numbers, so that a run that goes on gives the
/// same ones.
struct StepClock {
  double time = 0.0;  ///< at the step
  std::int64_t step = 0;
  double dt = 0.0;
  double at(std::int64_t later) const { return time + static_cast<double>(later - step) * dt; }
};

namespace event_settings_detail {

inline text_io::Parameters without(text_io::Parameters all,
                                   std::initializer_list<std::string_view> keys) {
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&keys](const auto &p) {
                             return std::find(keys.begin(), keys.end(), p.first) != keys.end();
                           }),
            all.end());
  return all;
}

}  // namespace event_settings_detail

/// Header of the catalogue. of_ruptures: of the events as ruptures, else of PE; slip_bin: width of
/// the bins as the grid has it.
inline CatalogueInfo catalogue_header(const EventSettings &settings, const SceneInfo &scene,
                                      bool of_ruptures, double slip_bin) {
  using text_io::number;
  CatalogueInfo info;
  info.model = "lsm";
  const auto add = [&](const std::string &key, const std::string &value) {
    if (!text_io::find(settings.parameters, key)) info.parameters.emplace_back(key, value);
  };
  for (const auto &[key, value] : scene.parameters) add(key, value);
  if (!of_ruptures) {
    add("picker", to_string(settings.picker.reading));
    add("lambda", number(settings.picker.lambda));
  }
  add("min_size", number(settings.picker.min_size));
  add("tangential_energy", settings.tangential ? "yes" : "no");
  if (settings.location) {
    add("slip_bin", number(settings.bin_width));
    add("rupture_fraction", number(settings.bin_fraction));
  }
  if (of_ruptures) {
    add("events", "ruptures");
    add("driving", number(settings.driving));
    add("slipping", number(settings.slipping));
    add("slip_velocity", number(settings.slipping * settings.driving));
    add("slip_bin", number(slip_bin));
    add("interval", std::to_string(settings.interval));
    add("gap", std::to_string(settings.gap));
    add("pause", number(settings.pause));
    add("modulus", number(settings.modulus));
  }
  add("ranks", std::to_string(scene.ranks));
  info.parameters.insert(info.parameters.end(), settings.parameters.begin(),
                         settings.parameters.end());
  info.slip_moment = info.x_centroid = info.rupture_length = settings.location || of_ruptures;
  info.x_hypocentre = info.x_begin = info.mean_slip = info.stress_drop = of_ruptures;
  return info;
}

/// Header of the PE series, which is the same whatever the events are. Holds the numbers that times
/// are computed from, so that a reader gets the times of the catalogue.
inline PeSeriesInfo series_header(const EventSettings &settings, const SceneInfo &scene,
                                  const StepClock &clock) {
  PeSeriesInfo info;
  info.model = "lsm";
  info.dt = scene.dt;
  info.step0 = clock.step;
  info.time0 = clock.time;
  info.stride = settings.series_stride;
  info.own_times = settings.own_times;
  info.parameters = event_settings_detail::without(
      catalogue_header(settings, scene, false, 0.0).parameters, {"dt"});
  return info;
}

inline SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
                                      const FaultGrid &grid) {
  SlipHistoryInfo info;
  info.grid = grid;
  info.ruptures = settings.rupture_settings(grid.dt);
  info.driving = settings.driving;
  info.quiet = settings.quiet;
  info.parameters = event_settings_detail::without(
      catalogue_header(settings, scene, true, grid.width).parameters,
      {"dt", "slip_velocity", "interval", "gap", "modulus", "driving", "slip_bin", "events"});
  if (!grid.ring) info.parameters.emplace_back("ends", "open");
  return info;
}

}  // namespace LSM

#endif
