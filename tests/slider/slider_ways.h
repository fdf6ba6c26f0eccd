// SPDX-License-Identifier: GPL-2.0-or-later
// What the tests of the block-slider share: blocks between elastic blocks, every way to step, and
// files that runs write.
#ifndef LSM_TESTS_SLIDER_WAYS_H
#define LSM_TESTS_SLIDER_WAYS_H

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "slider_parameters.h"
#include "slider_stiffness.h"

namespace Slider {

inline Parameters coupled(Coupling coupling, int blocks, double kl = 0.01) {
  Parameters p;
  p.blocks = blocks;
  p.kl = kl;
  p.modes = modes_of(coupling, strip_of_leaf_spring(coupling, p.kc, kl), blocks);
  return p;
}

/// Every combination of scheme, law, radiation and coupling that a run can ask for.
struct Way {
  Scheme scheme;
  Law law;
  double radiation;
  bool modes;
};
inline std::vector<Way> all_ways() {
  std::vector<Way> ways = {{Scheme::printed, Law::velocity_weakening, 0.0, false},
                           {Scheme::adams_bashforth, Law::coulomb, 1.5, true}};
  for (const Law law : {Law::velocity_weakening, Law::coulomb})
    for (const bool modes : {false, true})
      for (const double radiation : {0.0, 0.3})
        ways.push_back({Scheme::verlet, law, radiation, modes});
  return ways;
}
inline std::string name(const Way &w) {
  return std::string(to_string(w.scheme)) + " " + to_string(w.law) + " " +
         std::to_string(w.radiation) + (w.modes ? " modes" : " springs");
}
inline Parameters parameters_of(const Way &w, int blocks) {
  Parameters p = w.modes ? coupled(Coupling::antiplane, blocks, 0.1) : Parameters();
  p.blocks = blocks;
  p.kl = 0.1;
  p.velocity = 0.1;
  p.scheme = w.scheme;
  p.friction = {w.law, 0.7};
  p.radiation = w.radiation;
  if (w.scheme == Scheme::adams_bashforth) p.mass = 0.0;
  return p;
}

inline std::string text(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace Slider

#endif
