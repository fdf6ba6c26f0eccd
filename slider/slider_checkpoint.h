// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_checkpoint.h
/// Checkpoints hold all that a run needs to continue to the last digit:
///
///   slider_cli checkpoint VERSION CRC       CRC-32 of all that follows
///   key = value                             one line for each setting
///                                           an empty line, then doubles, see files/state.h
#ifndef SLIDER_CHECKPOINT_H
#define SLIDER_CHECKPOINT_H

#include <cstdint>
#include <string>
#include <vector>

#include "events/event_filter.h"
#include "events/event_picker.h"
#include "slider_chain.h"
#include "slider_ruptures.h"

namespace Slider {

/// Counts of the events of a run so far.
struct EventCounts : LSM::FilterCounts {
  /// Drops of PE that slip does not explain, see is_by_plate()
  std::int64_t by_plate = 0;
  double largest = 0.0;  ///< size of the largest event
};

/// State of a run between two steps.
struct RunState : EventCounts {
  ChainState chain;
  LSM::PickerState picker;      ///< of drops of PE
  double slip_start = 0.0;      ///< sum of all displacements when the present event began
  std::vector<double> u_start;  ///< displacements when it began
  RuptureState ruptures;
  std::int64_t calm_since = 0;  ///< last step with a block too fast for a leap, or end of a leap

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state.raw(self.picker);
    LSM::FilterCounts::visit(self, state);
    state(self.by_plate, self.largest, self.chain, self.slip_start);
    state.list(self.u_start);
    state.list(self.ruptures.open);
    state.list(self.ruptures.recent);
    state(self.calm_since);
  }
};

/// Replaces the file atomically, so that a complete checkpoint exists at any moment.
/// \param settings everything that influences the run, as "key = value"
/// \throws std::runtime_error
void write_checkpoint(const std::string &path, const std::vector<std::string> &settings,
                      const RunState &state);

/// Reads a checkpoint of a run with the same settings, but for those that may change
/// (header_keys.h). \throws std::runtime_error with one line if the file is damaged, or of another
/// version, or of a run with other settings, of which the first is named
RunState read_checkpoint(const std::string &path, const std::vector<std::string> &settings);

}  // namespace Slider

#endif
