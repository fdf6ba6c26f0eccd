// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_kernels.h
/// One time step of listed chunks of blocks, for each scheme, law and coupling that fit together.
/// It is compiled for several instruction sets, which agree to the last digit: operations are
/// grouped in fixed lanes, whatever the width of the registers, and contraction is off.
#ifndef SLIDER_KERNELS_H
#define SLIDER_KERNELS_H

#include <array>
#include <cstdint>

#include "slider_array.h"
#include "slider_modes.h"
#include "slider_parameters.h"

namespace Slider {

/// Arrays of the chain. Each has room for whole chunks and one more value on either side of the
/// blocks, where u keeps its periodic images u[-1] and u[blocks]. Blocks past the end have a
/// coefficient that no force exceeds. If modes couple the blocks, all chunks are listed, or none.
struct ChainView : Parameters {
  double *u = nullptr;         ///< displacement
  double *v = nullptr;         ///< velocity, >= 0
  double *force = nullptr;     ///< spring force at the present time (older for inactive chunks)
  const double *mu = nullptr;  ///< static coefficient
  double *ahead = nullptr;     ///< without inertia: slip in the next step; < 0: it stops after it
  // With modes only:
  ModeForces *forces = nullptr;
  ModeArrays of_modes = {};
  double *change = nullptr;  ///< of the displacements in this step

  /// Force of the other blocks on block i
  double coupling(int i) const {
    return by_springs() ? kc * ((u[i - 1] - u[i]) + (u[i + 1] - u[i])) : of_modes.coupling[i];
  }
  /// Force of all springs on block i
  double pull(int i, double plate) const { return coupling(i) + kl * (plate - u[i]); }
};

/// Sums over the listed chunks in one step.
struct StepSums {
  double work = 0.0;     ///< sum (F_old + F_new) du / 2, the work of the springs on the blocks
  double slip = 0.0;     ///< sum du
  std::int64_t hot = 0;  ///< number of blocks that move or are about to move
};

/// Takes one step of the listed chunks (ascending, without duplicates) to the plate position x_new.
/// \param hot for each listed chunk, set to the lanes that move, or whose force exceeds mu, after
/// the step
using StepFunction = StepSums (*)(const ChainView &chain, const std::int32_t *list, int count,
                                  double x_new, std::uint8_t *hot);

/// Instruction sets for which a step is compiled: the baseline of the platform and wider ones.
enum class InstructionSet { avx512, avx2, baseline };
constexpr std::array<LSM::Named<InstructionSet>, 3> names_of(InstructionSet) {
  return {{{InstructionSet::avx512, "avx512"},
           {InstructionSet::avx2, "avx2"},
           {InstructionSet::baseline, "baseline"}}};
}

/// Whether this processor has the instruction set.
bool has(InstructionSet set);
InstructionSet widest_instruction_set();

/// Returns the kernel that these parameters need.
/// \throws std::invalid_argument if the processor lacks the instruction set, or scheme and model do
/// not fit together
StepFunction step_function(const Parameters &p, InstructionSet set);

}  // namespace Slider

#endif
