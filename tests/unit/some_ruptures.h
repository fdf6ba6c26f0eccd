// SPDX-License-Identifier: GPL-2.0-or-later
// A grid and settings for tests of ruptures, of a line and of a plane.
#ifndef LSM_UNIT_SOME_RUPTURES_H
#define LSM_UNIT_SOME_RUPTURES_H

#include <cstdint>

#include "events/ruptures.h"
#include "events/slip_recorder.h"

namespace unit {

/// Bins of width 2 from x = -5; intervals of 4 steps of 0.25; slips above 0.005 count.
inline LSM::FaultGrid some_grid(int bins = 10) {
  LSM::FaultGrid grid;
  grid.bins = bins;
  grid.x0 = -5.0;
  grid.width = 2.0;
  grid.step0 = 1000;
  grid.interval = 4;
  grid.time0 = 50.0;
  grid.dt = 0.25;
  return grid;
}

inline LSM::RuptureSettings some_settings(int gap = 0, std::int64_t memory = 1) {
  LSM::RuptureSettings settings;
  settings.velocity = 0.005;
  settings.gap = gap;
  settings.memory = memory;
  settings.modulus = 0.5;
  return settings;
}

}  // namespace unit

#endif
