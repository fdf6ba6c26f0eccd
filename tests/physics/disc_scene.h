// SPDX-License-Identifier: GPL-2.0-or-later
/// \file disc_scene.h
/// Scenes of a few discs for the physics tests.
#ifndef LSM_PHYSICS_DISC_SCENE_H
#define LSM_PHYSICS_DISC_SCENE_H

#include <string>
#include <utility>
#include <vector>

namespace physics {

/// Settings for discs or spheres of radius 1, after dimension and boundary.
inline const std::string spheres_of_radius_1 = R"(
newton            ${newton}
atom_style        hybrid bond sphere
atom_modify       map array
comm_modify       mode single cutoff 4.5
neighbor          0.4 bin
neigh_modify      delay 0 every 1 check yes
)";

inline const std::string discs_start = R"(
variable newton   index on
units             lj
dimension         2
boundary          f f p
)" + spheres_of_radius_1 + "special_bonds     lj/coul 0 1 1\n";

/// Discs of radius 1 and type 1 at the given centres (x, y) in a box of 60 x 20.
inline std::string discs(const std::vector<std::pair<std::string, std::string>> &centres,
                         int bond_types = 1, int types = 1) {
  std::string text = discs_start + "region box block -30 30 -10 10 -0.5 0.5\ncreate_box " +
                     std::to_string(types) + " box bond/types " + std::to_string(bond_types) +
                     " extra/bond/per/atom 6 extra/special/per/atom 12\n";
  for (const auto &c : centres)
    text += "create_atoms 1 single " + c.first + " " + c.second + " 0\n";
  return text + "set group all diameter 2.0\nset group all mass 1.0\n";
}

inline const char *const disc_columns =
    "thermo_style custom step bonds ke pe c_events c_events[5] c_events[6] c_events[7] c_events[8] "
    "c_events[9] c_events[11] c_events[13] c_events[14]\n"
    "thermo_modify norm no format float %.17g\n";

/// A chain of discs along x whose links are of type 1 and 2 in turn, and whose last disc is pulled.
inline std::string two_link_types(int count) {
  std::vector<std::pair<std::string, std::string>> centres;
  for (int n = 0; n < count; ++n) centres.emplace_back(std::to_string(2 * n - count), "0");
  std::string text = discs(centres, 2);
  for (int n = 1; n < count; ++n)
    text += "create_bonds single/bond " + std::to_string(n % 2 ? 1 : 2) + " " + std::to_string(n) +
            " " + std::to_string(n + 1) + "\n";
  return text + R"(
variable          ratio index 1.02
bond_style        lsm/linked
bond_coeff        1 1.0
bond_coeff        2 1.0 ${ratio}
pair_style        lsm/free
pair_coeff        1 1 1.0
timestep          0.02
group             last id )" +
         std::to_string(count) + R"(
fix               move all lsm/nve
compute           events all lsm/events ledger yes strainlimit 10
)" + disc_columns;
}

}  // namespace physics

#endif
