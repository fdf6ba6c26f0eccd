// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_kernels.h"

#include <immintrin.h>

#include <cstring>
#include <stdexcept>

// Vectors only travel between functions that are inlined, so how they would be passed is moot.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace Slider {

namespace KernelX86 {
#define SLIDER_LANES 2
#include "slider_kernel_body.h"
#undef SLIDER_LANES
}  // namespace KernelX86

#pragma GCC push_options
#pragma GCC target("avx2,popcnt")
namespace KernelAvx2 {
#define SLIDER_LANES 4
#include "slider_kernel_body.h"
#undef SLIDER_LANES
}  // namespace KernelAvx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw,popcnt")
namespace KernelAvx512 {
#define SLIDER_LANES 8
#include "slider_kernel_body.h"
#undef SLIDER_LANES
}  // namespace KernelAvx512
#pragma GCC pop_options

namespace {
bool has(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2");
    default:
      return true;
  }
}
}  // namespace

InstructionSet resolve(InstructionSet wanted) {
  if (wanted != InstructionSet::automatic) {
    if (!has(wanted))
      throw std::invalid_argument(std::string("--isa = ") + to_string(wanted) +
                                  ", expected an instruction set this processor has");
    return wanted;
  }
  for (InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
    if (has(set)) return set;
  return InstructionSet::x86_64;
}

StepFunction step_function(int scheme, Law law, InstructionSet set) {
  const InstructionSet found = resolve(set);
  const int row = static_cast<int>(law);
  return found == InstructionSet::avx512 ? KernelAvx512::functions[row][scheme]
         : found == InstructionSet::avx2 ? KernelAvx2::functions[row][scheme]
                                         : KernelX86::functions[row][scheme];
}

}  // namespace Slider
