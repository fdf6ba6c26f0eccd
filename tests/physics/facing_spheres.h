// SPDX-License-Identifier: GPL-2.0-or-later
/// \file facing_spheres.h
/// Two rows, or planes, of spheres that face each other, for tests of slip and ruptures.
#ifndef LSM_PHYSICS_FACING_SPHERES_H
#define LSM_PHYSICS_FACING_SPHERES_H

#include <string>

#include "disc_scene.h"

namespace physics {

/// Spheres of diameter 2 and mass 1, the lower ones of type 1 and each upper one, of type 2, right
/// above one with an overlap of 0.01; IDs of the lower ones first.
/// \param rows   number along z; 0: two dimensions
/// \param begin  dimension and boundary, as commands
/// \param box    limits of the box
inline std::string facing_spheres(int bins, int rows, const std::string &begin,
                                  const std::string &box) {
  std::string script = R"(
variable          newton index off
units             lj
)" + begin + spheres_of_radius_1 +
                       R"(
region            box block )" +
                       box + "\ncreate_box        2 box\n";
  for (const char *of : {"1 single ", "2 single "})
    for (int n = 0; n < bins; ++n)
      for (int m = 0; m < (rows ? rows : 1); ++m)
        script += std::string("create_atoms ") + of + std::to_string(2 * n + 1) +
                  (of[0] == '1' ? " 0.0 " : " 1.99 ") +
                  std::to_string(rows ? 2 * m - 2 * rows + 1 : 0) + "\n";
  return script + R"(
set               group all diameter 2.0
set               group all mass 1.0
group             below type 1
group             above type 2
group             lowerface type 1
group             upperface type 2
pair_style        lsm/friction
pair_coeff        * * off
pair_coeff        1 2 1.0 1.0 1e-5
timestep          0.1
thermo            1000
)";
}

}  // namespace physics

#endif
