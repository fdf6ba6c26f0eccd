// SPDX-License-Identifier: GPL-2.0-or-later
// Seconds of the straightforward loop over all blocks, with the picker in every step: what the
// kernels of slider_cli are compared with. Usage: lsm_bench_plain_loop SCHEME BLOCKS DT STEPS
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "events/event_picker.h"
#include "scalar_chain.h"

int main(int argc, char **argv) {
  Slider::Parameters p;
  if (argc != 5 || !Slider::from_string(argv[1], p.scheme)) {
    std::fprintf(stderr, "usage: lsm_bench_plain_loop SCHEME BLOCKS DT STEPS\n");
    return 2;
  }
  p.blocks = std::atoi(argv[2]);
  p.dt = std::atof(argv[3]);
  const double steps = std::atof(argv[4]);
  Slider::ScalarChain chain(p, Slider::random_friction(p.blocks, 0.5, 1.0, 1));
  LSM::EventPicker picker({});
  LSM::Event event;
  picker.push_change(0, 0.0, chain.pe(), 0.0, event);
  const auto start = std::chrono::steady_clock::now();
  while (static_cast<double>(chain.step()) < steps) {
    chain.advance();
    picker.push_change(chain.step(), p.dt * static_cast<double>(chain.step()), chain.pe(),
                       chain.dpe(), event);
  }
  std::printf("%.6g\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return 0;
}
