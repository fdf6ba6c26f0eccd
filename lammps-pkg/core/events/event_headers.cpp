// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_headers.h"

#include <string>

#include "events/pe_drops.h"

namespace LSM {

std::vector<Output> files_of(const EventSettings &settings) {
  return {{"catalogue", settings.catalogue_file},
          {"series", settings.series_file},
          {"history", settings.history_file}};
}

CatalogueInfo catalogue_header(const EventSettings &settings, const EventKind &kind,
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

PeSeriesInfo series_header(const EventSettings &settings, const SceneInfo &scene,
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

SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
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
