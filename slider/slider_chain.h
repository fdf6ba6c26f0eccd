// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_chain.h
/// The chain of blocks, coupled by springs or modes. Either all chunks are stepped (the dense
/// reference) or only those of the active set.
///
/// Both give the same numbers to the last digit: sums are kept in fixed lanes, to which a skipped
/// chunk would only have added zeros.
#ifndef SLIDER_CHAIN_H
#define SLIDER_CHAIN_H

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "slider_active_set.h"
#include "slider_array.h"
#include "slider_creep.h"
#include "slider_energy.h"
#include "slider_kernels.h"
#include "slider_modes.h"
#include "slider_parameters.h"

namespace Slider {

class Chain {
 public:
  /// \param dense whether all chunks are stepped in every step
  Chain(const Parameters &p, const std::vector<double> &mu, bool dense,
        InstructionSet set = widest_instruction_set());
  Chain(const Chain &) = delete;
  Chain &operator=(const Chain &) = delete;

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_) * view_.dt; }
  double plate() const { return plate_step_ * static_cast<double>(step_); }
  double pe() const { return account_.value(); }
  double dpe() const { return account_.change(); }         ///< change of PE over the last step
  double slip_sum() const { return account_.slip_sum(); }  ///< sum of all displacements
  std::int64_t moved() const { return moved_; }

  /// Displacements and velocities, one per block.
  std::vector<double> displacements() const { return {view_.u, view_.u + view_.blocks}; }
  std::vector<double> velocities() const { return {view_.v, view_.v + view_.blocks}; }

  /// Takes one time step.
  void advance() {
    take_step();
    active_.update(step_);
  }

  /// Takes the same time step and reports to `watch`, in ascending order, each block that slid,
  /// with the work of the springs on it, (F_old + F_new) du / 2 (see RuptureTracker).
  template <class Watch>
  void advance(Watch &watch) {
    const double pe_old = pe();
    keep_chunks();
    take_step();
    watch.begin_step(step_, pe_old);
    if (!account_.quiet()) {
      const Kept *old = kept_.data();
      for (const std::int32_t c : active_.list()) {
        const int begin = c * chunk_size, end = std::min(begin + chunk_size, view_.blocks);
        for (int i = begin; i < end; ++i)
          if (const double slip = view_.u[i] - old->u[i - begin]; slip != 0.0)
            watch.slide(i, 0.5 * (old->force[i - begin] + view_.force[i]) * slip, slip);
        ++old;
      }
    }
    active_.update(step_);
  }

  /// Step up to which nothing can move, which is the present step if something moves or may move.
  std::int64_t quiet_until() {
    return active_.list().empty() && account_.quiet() ? active_.next_wake() - 1 : step_;
  }
  /// Change of PE per step over a quiet step that starts at the given step.
  double quiet_change(std::int64_t at) const { return account_.quiet_change(at); }
  /// Jumps to a step no later than quiet_until().
  void jump(std::int64_t to) {
    step_ = to - 1;
    advance();
  }

  /// Velocity of the fastest block.
  double fastest() const;

  /// Leaps by creep without time steps (see Creep), to the step at which blocks are about to become
  /// fast, or PE begins or ceases to fall, or at most to `last`. At its end all blocks are at rest.
  /// \param least smallest number of steps that is worth a leap
  /// \param falls,rises whether PE may fall, or rise, during the leap
  /// \return false if there is no such leap, in which case nothing is changed
  bool leap(std::int64_t last, std::int64_t least, double fast, bool falls, bool rises);
  /// PE at a step within the last leap.
  double pe_in_leap(std::int64_t at) const;

  ChainState state() const;
  /// Continues from a saved state.
  void set_state(const ChainState &s);

 private:
  // State of a chunk before a step.
  struct Kept {
    double u[chunk_size], force[chunk_size];
  };

  ChainView view_of(const Parameters &p, const std::vector<double> &mu);
  void keep_chunks();
  void take_step();
  bool draw_strength(int block);
  void restart();

  double plate_step_;
  StepFunction function_;
  Array u_, v_, force_, mu_, ahead_, change_;
  std::unique_ptr<ModeForces> forces_;
  std::vector<double> first_mu_;  // at step 0
  // In a landscape: number of the cell that each block is in, and displacement at which it leaves
  // it.
  std::vector<std::int64_t> cells_;
  Array ends_;
  std::vector<Kept> kept_;  // of the listed chunks, if advance() has to report slips
  ChainView view_;
  ActiveSet active_;
  PeAccount account_;
  std::int64_t step_ = 0, moved_ = 0;
  std::vector<Creep::Piece> leap_pieces_;  // of the last leap
  std::int64_t leap_from_ = 0;
  double leap_pe_ = 0.0;
};

}  // namespace Slider

#endif
