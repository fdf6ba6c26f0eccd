// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_checkpoint.h
/// Checkpoints hold all that a run needs to continue to the last digit, as CBOR (RFC 8949) with a
/// CRC-32.
#ifndef SLIDER_CHECKPOINT_H
#define SLIDER_CHECKPOINT_H

#include <cstdint>
#include <string>
#include <vector>

#include "events/event_picker.h"
#include "slider_chain.h"
#include "slider_ruptures.h"

namespace Slider {

/// Counts of the events of a run so far.
struct EventCounts {
  LSM::PickerState picker;                     ///< with ruptures, only the sizes that were dropped
  std::int64_t events = 0, before_warmup = 0;  ///< in the catalogue; too early
  /// Drops of PE that slip does not explain, see is_by_plate()
  std::int64_t by_plate = 0;
  double largest = 0.0;  ///< size of an event
};

/// State of a run between two steps.
struct RunState : EventCounts {
  ChainState chain;
  double slip_start = 0.0;      ///< sum of displacements when the present event began
  std::vector<double> u_start;  ///< displacements then
  RuptureState ruptures;
  std::int64_t calm_since = 0;  ///< last step with a block too fast for a leap, or of a leap
};

/// Replaces the file atomically, so that there is a complete checkpoint at any moment.
/// \param settings "key = value" of everything that influences the run
/// \throws std::runtime_error
void write_checkpoint(const std::string &path, const std::vector<std::string> &settings,
                      const RunState &state);

/// \throws std::runtime_error with one line for a damaged file, one of another version, or one of a
/// run with other settings, naming the first that differs
RunState read_checkpoint(const std::string &path, const std::vector<std::string> &settings);

}  // namespace Slider

#endif
