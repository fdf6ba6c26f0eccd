// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_kernels.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include <cstring>
#include <stdexcept>

// Vectors only travel between functions that are inlined, so how they would be passed is moot.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace Slider {

namespace KernelBaseline {
#define SLIDER_LANES 2
#include "slider_kernel_body.h"
#undef SLIDER_LANES
}  // namespace KernelBaseline

#ifdef __x86_64__
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
#endif

const char *to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::automatic:
      return "auto";
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::baseline:
      break;
  }
#ifdef __x86_64__
  return "x86-64";
#else
  return "baseline";
#endif
}

bool has(InstructionSet set) {
#ifdef __x86_64__
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
#endif
  return set == InstructionSet::automatic || set == InstructionSet::baseline;
}

InstructionSet widest_instruction_set() {
  for (InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
    if (has(set)) return set;
  return InstructionSet::baseline;
}

StepFunction step_function(Scheme scheme, Law law, InstructionSet set) {
  if (!has(set)) throw std::invalid_argument(std::string("no instruction set ") + to_string(set));
  if (set == InstructionSet::automatic) set = widest_instruction_set();
#ifdef __x86_64__
  if (set == InstructionSet::avx512) return KernelAvx512::function_of(scheme, law);
  if (set == InstructionSet::avx2) return KernelAvx2::function_of(scheme, law);
#endif
  return KernelBaseline::function_of(scheme, law);
}

}  // namespace Slider
