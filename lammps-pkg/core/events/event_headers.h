// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_headers.h
/// Headers of the files that a lattice solid run writes about its events.
#ifndef LSM_EVENT_HEADERS_H
#define LSM_EVENT_HEADERS_H

#include <cstdint>
#include <vector>

#include "events/event_settings.h"
#include "files/catalogue.h"
#include "files/output_claim.h"
#include "files/parameters.h"
#include "files/pe_series.h"
#include "files/slip_history.h"

namespace LSM {

/// What headers state about the scene.
struct SceneInfo {
  files::Parameters parameters;  ///< in the order of the file
  int ranks = 1;
  double dt = 1.0;
};

/// Converts steps to times. Restart files keep these numbers, so that a continued run has the same
/// times.
struct StepClock {
  double time = 0.0;  ///< time at `step`
  std::int64_t step = 0;
  double dt = 0.0;
  double at(std::int64_t later) const { return time + static_cast<double>(later - step) * dt; }
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.time, self.step, self.dt);
  }
};

/// The files that a recorder writes, by their keywords; paths of those not written are empty.
std::vector<Output> files_of(const EventSettings &settings);

/// Headers of the two catalogues.
/// \param grid if slip is recorded
CatalogueInfo drops_header(const EventSettings &settings, const SceneInfo &scene,
                           const FaultGrid &grid);
/// The parameter `events` states that ruptures may overlap.
CatalogueInfo ruptures_header(const EventSettings &settings, const SceneInfo &scene,
                              const FaultGrid &grid);

/// Header of the PE series, whether slip is recorded or not. It has the numbers that times are
/// computed from, so that readers obtain the times of the catalogue.
PeSeriesInfo series_header(const EventSettings &settings, const SceneInfo &scene,
                           const StepClock &clock);

SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
                               const FaultGrid &grid);

}  // namespace LSM

#endif
