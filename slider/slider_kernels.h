// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_kernels.h
/// One time step of listed chunks of blocks, for each scheme and law, with springs or modes.
/// Compiled for several instruction sets, which agree to the last digit: the arithmetic is that of
/// fixed lanes, whatever the width of the registers, and contraction is off.
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
/// coefficient that no force exceeds. Coupled by modes, all chunks are listed, or none.
struct ChainView : Parameters {
  double *u = nullptr;         ///< displacement
  double *v = nullptr;         ///< velocity, >= 0
  double *force = nullptr;     ///< spring force at the present time (older for inactive chunks)
  double *rest = nullptr;      ///< where a block last rested, if the law needs it
  const double *mu = nullptr;  ///< static coefficient
  double stiffness = 0.0;      ///< of a block that moves alone
  double *ahead = nullptr;     ///< slip in the next step, without inertia; < 0: and then it stops
  // With modes only:
  ModeForces *forces = nullptr;
  ModeArrays of_modes = {};
  double *change = nullptr;  ///< of the displacements in this step
};

/// Sums over the listed chunks in one step.
struct StepSums {
  double work = 0.0;      ///< sum (F_old + F_new) du / 2, the work of the springs on the blocks
  double slip = 0.0;      ///< sum du
  double radiated = 0.0;  ///< sum radiation (v_old + v_new) du / 2
  std::int64_t hot = 0;   ///< number of blocks that move or are about to
};

/// Takes one step of the listed chunks (ascending, no repeats) to plate position x_new. hot[k] gets
/// the lanes of chunk list[k] that move, or whose force exceeds mu, after the step.
using StepFunction = StepSums (*)(const ChainView &chain, const std::int32_t *list, int count,
                                  double x_new, std::uint8_t *hot);

/// Instruction sets that a step is compiled for: the baseline of the platform, or wider ones.
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
/// \throws std::invalid_argument if the processor lacks the set asked for.
StepFunction step_function(const Parameters &p, InstructionSet set);

}  // namespace Slider

#endif
