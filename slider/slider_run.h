// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_run.h
/// A run of the block-slider: its settings and its results.
#ifndef SLIDER_RUN_H
#define SLIDER_RUN_H

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "events/event_filter.h"
#include "events/event_picker.h"
#include "files/names.h"
#include "files/output_claim.h"
#include "slider_checkpoint.h"
#include "slider_parameters.h"

namespace Slider {

/// Definition of an event: a drop of the PE of the whole chain (paper), or a connected set of
/// sliding blocks † (see slider_ruptures.h).
enum class Events { pe, ruptures };
constexpr std::array<LSM::Named<Events>, 2> names_of(Events) {
  return {{{Events::pe, "pe"}, {Events::ruptures, "ruptures"}}};
}

struct RunOptions {
  Parameters parameters;
  std::vector<double> mu;  ///< one per block
  std::int64_t steps = 0;
  Events events = Events::pe;
  LSM::PickerSettings picker;  ///< of drops of PE
  LSM::FilterSettings filter{0.0, false, 0.0};
  double leap_speed = 0.0;    ///< leap only while no block is faster than this; 0: no leaps
  bool keep_by_plate = true;  ///< write drops of PE that slip does not explain, see is_by_plate()
  bool dense = false;         ///< step all blocks, not only those that may move; for tests
  std::string catalogue;      ///< empty: none
  bool x_centroid = false, rupture_length = false;
  std::string series;  ///< empty: none
  std::int64_t series_stride = 1;
  std::string checkpoint;  ///< empty: none
  std::int64_t checkpoint_interval = 0;
  bool resume = false;
  bool overwrite = false;  ///< replace files of an earlier run
  bool progress = false;
  std::vector<std::pair<std::string, std::string>> header;  ///< all that influences the result
  const std::atomic<int> *stop = nullptr;  ///< a signal number stored here ends the run
};

/// Time for which no block must have been fast before a leap. A block that runs away becomes fast
/// within it.
constexpr double leap_calm = 50.0;

/// Whether the plate, and not slip, has lowered PE: after an overshoot the blocks are ahead of the
/// plate, and PE falls until it has caught up. From rest to rest, blocks lose to friction no more
/// than the highest strength times the total slip, so that the plate has taken whatever exceeds
/// this † (the paper counts all drops).
/// \param strongest highest strength of the blocks
inline bool is_by_plate(const LSM::Drop &drop, double strongest) {
  return drop.size > strongest * drop.slip_moment;
}

struct RunResult : EventCounts {
  std::int64_t first_step = 0, steps = 0;  ///< first and last step
  std::int64_t moved = 0;                  ///< steps in which a block moved, summed over blocks
  std::int64_t jumped = 0;                 ///< number of quiet steps that were jumped over
  std::int64_t leaps = 0, leapt = 0;       ///< number of leaps, and of the steps they replace
  double pe = 0.0, pe_direct = 0.0;        ///< at the end: by work, and summed over all springs
  double mean_slip = 0.0, seconds = 0.0;
  int interrupted = 0;  ///< signal number, or 0
};

/// Checks early whether an output can be written; an empty path means none.
/// \throws LSM::FileError
void probe(const std::string &path);

/// The files that a run writes as it goes.
std::vector<LSM::Output> outputs_of(const RunOptions &options);

/// Refuses to replace files that are not empty, unless the options allow it.
/// \throws std::runtime_error naming file and options
void check_replaced(const RunOptions &options);

/// Runs or continues one chain.
/// \throws std::exception with one line if input or output fails
RunResult run(const RunOptions &options);

}  // namespace Slider

#endif
