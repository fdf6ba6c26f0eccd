// SPDX-License-Identifier: GPL-2.0-or-later
#include "events/event_headers.h"

#include <string>

namespace LSM {

namespace {

using files::Parameters;
using text::number;

/// What describes the events stands between the lines of the scene and those of the user, who may
/// replace each of them.
/// \param left_out file that was left out by name, or ""
Parameters parameters_of(const EventSettings &settings, const SceneInfo &scene,
                         const Parameters &events, const std::string &left_out = "") {
  Parameters all = scene.parameters;
  all.insert(all.end(), events.begin(), events.end());
  all.emplace_back("ranks", std::to_string(scene.ranks));
  if (!left_out.empty()) all.emplace_back(left_out, "none");
  Parameters out;
  for (auto &one : all)
    if (!files::find(settings.parameters, one.first)) out.push_back(std::move(one));
  out.insert(out.end(), settings.parameters.begin(), settings.parameters.end());
  return out;
}

Parameters picker_of(const EventSettings &settings) {
  return {{"picker", to_string(settings.picker.reading)},
          {"lambda", number(settings.picker.lambda)},
          {"min_size", number(settings.drops.min_size)},
          {"tangential_energy", settings.tangential ? "yes" : "no"}};
}

/// Adds the parameters that a binary header does not have as numbers of its own.
template <class Info>
void add_others(Info &info, const Parameters &parameters) {
  const Parameters own = info.header();
  for (const auto &one : parameters)
    if (!files::find(own, one.first)) info.parameters.push_back(one);
}

}  // namespace

std::vector<Output> files_of(const EventSettings &settings) {
  return {{"catalogue", settings.catalogue_file},
          {"series", settings.series_file},
          {"ruptures", settings.ruptures_file},
          {"history", settings.history_file}};
}

CatalogueInfo drops_header(const EventSettings &settings, const SceneInfo &scene,
                           const FaultGrid &grid) {
  CatalogueInfo info;
  info.model = "lsm";
  Parameters events = picker_of(settings);
  const bool located = settings.records_slip() && !grid.plane;
  if (located) {
    events.emplace_back("slip_bin", number(grid.width));
    events.emplace_back("rupture_fraction", number(settings.fraction));
    events.emplace_back("interval", std::to_string(settings.interval));
    events.emplace_back("modulus", number(settings.modulus));
  }
  if (located) add_names(info.columns, slip_of_drops);
  if (settings.finds_ruptures()) add_names(info.columns, friction_of_drops);
  info.parameters = parameters_of(settings, scene, events, settings.no_series ? "series" : "");
  return info;
}

CatalogueInfo ruptures_header(const EventSettings &settings, const SceneInfo &scene,
                              const FaultGrid &grid) {
  CatalogueInfo info;
  info.model = "lsm";
  Parameters events = {{"min_size", number(settings.ruptures.min_size)},
                       {"tangential_energy", settings.tangential ? "yes" : "no"},
                       {"events", "ruptures"},
                       {"driving", number(settings.driving)},
                       {"slipping", number(settings.slipping)},
                       {"slip_velocity", number(settings.slipping * settings.driving)},
                       {"slip_bin", number(grid.width)},
                       {"interval", std::to_string(settings.interval)},
                       {"gap", std::to_string(settings.gap)},
                       {"pause", number(settings.pause)},
                       {"modulus", number(settings.modulus)}};
  if (grid.plane) events.emplace_back("slip_bin_dip", number(grid.height));
  info.parameters = parameters_of(settings, scene, events, settings.no_history ? "history" : "");
  add_names(info.columns, columns_of_ruptures);
  if (grid.plane) add_names(info.columns, columns_of_planes);
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
  add_others(info, parameters_of(settings, scene, picker_of(settings)));
  return info;
}

SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
                               const FaultGrid &grid) {
  SlipHistoryInfo info;
  info.grid = grid;
  info.ruptures = settings.rupture_settings(grid.dt);
  info.driving = settings.driving;
  info.quiet = settings.quiet;
  // The width of the bins has its own key, and the history is no catalogue.
  add_others(info, files::without(ruptures_header(settings, scene, grid).parameters,
                                  {"slip_bin", "slip_bin_dip", "events"}));
  if (!grid.ring) info.parameters.emplace_back("ends", "open");
  if (grid.plane && !grid.ring_dip) info.parameters.emplace_back("ends_dip", "open");
  return info;
}

}  // namespace LSM
