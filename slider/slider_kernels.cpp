// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_kernels.h"

#include <stdexcept>

namespace Slider {

// Defined in slider_kernel.cpp, once for each instruction set.
namespace baseline {
StepFunction function_of(const Parameters &p);
}
#ifdef __x86_64__
namespace avx2 {
StepFunction function_of(const Parameters &p);
}
namespace avx512 {
StepFunction function_of(const Parameters &p);
}
#endif

bool has(InstructionSet set) {
#ifdef __x86_64__
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
#endif
  return set == InstructionSet::baseline;
}

InstructionSet widest_instruction_set() {
  for (InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
    if (has(set)) return set;
  return InstructionSet::baseline;
}

StepFunction step_function(const Parameters &p, InstructionSet set) {
  if (!has(set)) throw std::invalid_argument(std::string("no instruction set ") + to_string(set));
  check_scheme(p);
#ifdef __x86_64__
  if (set == InstructionSet::avx512) return avx512::function_of(p);
  if (set == InstructionSet::avx2) return avx2::function_of(p);
#endif
  return baseline::function_of(p);
}

}  // namespace Slider
