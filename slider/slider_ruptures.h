// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_ruptures.h
/// Events as ruptures: sets of sliding blocks connected in space and time † (the paper picks
/// drops of the potential energy (PE) of the whole chain).
///
/// Block i slides in step n if the step changes its displacement. It is then connected with the
/// blocks i - 1, i and i + 1 (periodic) that slide in step n or in one of the memory steps before
/// it. A rupture is a connected set of such pairs (i, n): it ends when no sliding block can connect
/// with it any more, and two that meet become one. A memory of one step covers direct causation: a
/// block that stops in step n may push its neighbour over its limit for step n + 1.
///
/// Unlike drops of the total PE, ruptures that are far apart in a long chain remain separate
/// events.
#ifndef SLIDER_RUPTURES_H
#define SLIDER_RUPTURES_H

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "numerics/circular_mean.h"
#include "events/slip_sets.h"
#include "files/event.h"

namespace Slider {

/// A rupture in units of blocks and steps; energies and slips are in model units. Plain data
/// without padding, as checkpoints copy it.
struct Rupture : LSM::SlipSet {
  double size = 0.0;                      ///< work of all springs on the blocks
  double slip = 0.0;                      ///< sum of the slips of all blocks
  double slip_cos = 0.0, slip_sin = 0.0;  ///< slips times direction of the block on the ring
  double pe_start = 0.0, pe_end = 0.0;    ///< PE of the whole chain at step_start, step_end

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state.raw(self);
  }
  void absorb(const Rupture &later) {
    size += later.size;
    slip += later.slip;
    slip_cos += later.slip_cos;
    slip_sin += later.slip_sin;
  }
};
static_assert(std::is_trivially_copyable<Rupture>::value, "Rupture goes into checkpoints");

/// The state of a tracker between steps.
using RuptureState = LSM::SlipSetsState<Rupture>;

/// Combines slips into ruptures as they occur.
///
/// For each step, call begin_step(), then slide() for each block that slides, in ascending order,
/// then end_step(). The result depends on these calls only; a tracker restored by set_state()
/// continues to the last digit.
class RuptureTracker : public LSM::SlipSets<Rupture> {
 public:
  /// \param memory number of steps over which slips are connected, see above; at least 1
  /// \param centroid whether x_centroid is wanted
  RuptureTracker(int blocks, std::int64_t memory, bool centroid) : SlipSets(blocks, 1, memory) {
    if (!centroid) return;
    const double circle = 2.0 * LSM::pi / blocks;
    for (int i = 0; i < blocks; ++i) {
      cosine_.push_back(std::cos(circle * i));
      sine_.push_back(std::sin(circle * i));
    }
  }

  /// Begins the step that leads to the given one.
  /// \param pe_before PE before the step
  void begin_step(std::int64_t step, double pe_before) {
    SlipSets::begin_step(step);
    pe_before_ = pe_before;
  }

  /// Adds the slip of block i, slip > 0, and the work that the springs do on it.
  void slide(int i, double work, double slip) {
    Rupture &r = SlipSets::slide(i, [this](Rupture &begun) { begun.pe_start = pe_before_; });
    r.size += work;
    r.slip += slip;
    if (!cosine_.empty()) {
      r.slip_cos += slip * cosine_[static_cast<std::size_t>(i)];
      r.slip_sin += slip * sine_[static_cast<std::size_t>(i)];
    }
  }

  /// Ends the step. Calls finished(const Rupture &) for each rupture with which no slip can connect
  /// any more, in order of step_end, step_start, first block.
  /// \param pe PE after the step
  template <class Finished>
  void end_step(double pe, Finished &&finished) {
    SlipSets::end_step(
        [this, pe](Rupture &r) {
          if (r.step_end == step()) r.pe_end = pe;
        },
        finished);
  }

  /// The rupture as a row of a catalogue, without its number.
  LSM::Rupture event(const Rupture &r, double dt) const {
    LSM::Rupture e;
    e.step_start = r.step_start;
    e.step_end = r.step_end;
    e.t_start = dt * static_cast<double>(r.step_start);
    e.t_end = dt * static_cast<double>(r.step_end);
    e.size = r.size;
    e.pe_start = r.pe_start;
    e.pe_end = r.pe_end;
    e.slip_moment = r.slip;
    e.rupture_length = static_cast<double>(r.length);
    if (r.slip_cos != 0.0 || r.slip_sin != 0.0)
      e.x_centroid = LSM::part_of_ring(r.slip_sin, r.slip_cos) * places();
    return e;
  }

 private:
  double pe_before_ = 0.0;
  std::vector<double> cosine_, sine_;
};

}  // namespace Slider

#endif
