// SPDX-License-Identifier: GPL-2.0-or-later
/// \file events/event_headers.h
/// Headers of the files that a lattice solid run writes about its events.
#ifndef LSM_EVENT_HEADERS_H
#define LSM_EVENT_HEADERS_H

#include <cstdint>
#include <vector>

#include "events/event_kinds.h"
#include "events/event_picker.h"
#include "files/catalogue.h"
#include "files/output_claim.h"
#include "files/parameters.h"
#include "files/pe_series.h"
#include "files/slip_history.h"

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
std::vector<Output> files_of(const EventSettings &settings);

/// Header of the catalogue of that kind of events; slip_bin: width of the bins as the grid has it.
CatalogueInfo catalogue_header(const EventSettings &settings, const EventKind &kind,
                               const SceneInfo &scene, double slip_bin);

/// Header of the PE series, the same for all kinds of events. It has the numbers that times are
/// computed from, so that a reader gets the times of the catalogue.
PeSeriesInfo series_header(const EventSettings &settings, const SceneInfo &scene,
                           const StepClock &clock);

SlipHistoryInfo history_header(const EventSettings &settings, const SceneInfo &scene,
                               const FaultGrid &grid);

}  // namespace LSM

#endif
