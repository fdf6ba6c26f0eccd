// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_headers.h
/// Headers of the files that a lattice solid run writes about its events.
#ifndef LSM_EVENT_HEADERS_H
#define LSM_EVENT_HEADERS_H

#include <cstdint>
#include <string>
#include <vector>

#include "events/event_kinds.h"
#include "files/catalogue.h"
#include "events/event_picker.h"
#include "files/output_claim.h"
#include "files/pe_series.h"
#include "files/slip_history.h"
#include "files/text_io.h"

namespace LSM {

/// What the headers say about the scene.
struct SceneInfo {
  text_io::Parameters parameters;  ///< in the order of the file
  int ranks = 1;
  double dt = 1.0;
};

/// The times of steps: a restart file has these numbers, so that a continued run gives the same
/// times.
struct StepClock {
  double time = 0.0;  ///< at the step
  std::int64_t step = 0;
  double dt = 0.0;
  double at(std::int64_t later) const { return time + static_cast<double>(later - step) * dt; }
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.time, self.step, self.dt);
  }
};

/// What it writes, by keywords; paths are empty where it is not written.
inline std::vector<Output> files_of(const EventSettings &settings) {
  return {{"catalogue", settings.catalogue_file},
          {"series", settings.series_file},
          {"history", settings.history_file}};
}

/// Header of the catalogue of that kind of events; slip_bin: width of the bins as the grid has it.
inline CatalogueInfo catalogue_header(const EventSettings &settings, const EventKind &kind,
                                      const SceneInfo &scene, double slip_bin) {
  CatalogueInfo info;
  info.model = "lsm";
  const AddParameter add = [&](const std::string &key, const std::string &value) {
    if (!text_io::find(settings.parameters, key)) info.parameters.emplace_back(key, value);
  };
  for (const auto &[key, value] : scene.parameters) add(key, value);
  kind.describe(settings, slip_bin, add, info);
  add("ranks", std::to_string(scene.ranks));
  info.parameters.insert(info.parameters.end(), settings.parameters.begin(),
                         settings.parameters.end());
  return info;
}

/// Header of the PE series, the same for all kinds of events. It has the numbers that times are
/// computed from, so that a reader gets the times of the catalogue.
inline PeSeriesInfo series_header(const EventSettings &settings, const SceneInfo &scene,
                                  const StepClock &clock) {
  PeSeriesInfo info;
  info.model = "lsm";
  info.dt = scene.dt;
  info.step0 = clock.step;
  info.time0 = clock.time;
  info.stride = settings.series_stride;
  info.explicit_times = settings.explicit_times;
  const PeDrops drops;
  const EventKind &own = *settings.kind;
  const EventKind &kind = own.picks_pe() ? own : drops;
  info.parameters =
      text_io::without(catalogue_header(settings, kind, scene, 0.0).parameters, {"dt"});
  return info;
}

inline SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
                                      const FaultGrid &grid) {
  SlipHistoryInfo info;
  info.grid = grid;
  info.ruptures = settings.kind->rupture_settings(settings, grid.dt);
  info.driving = settings.driving;
  info.quiet = settings.quiet;
  info.parameters = text_io::without(
      catalogue_header(settings, *settings.kind, scene, grid.width).parameters,
      {"dt", "slip_velocity", "interval", "gap", "modulus", "driving", "slip_bin", "events"});
  if (!grid.ring) info.parameters.emplace_back("ends", "open");
  return info;
}

}  // namespace LSM

#endif
