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

/// Links, free contacts of stiffness 1, and motion.
/// \param bonds  commands that create links, and coefficients of links
inline std::string linked(const std::string &bonds, const std::string &coefficients,
                          const std::string &dt) {
  return bonds + "bond_style lsm/linked\n" + coefficients +
         "pair_style lsm/free\npair_coeff 1 1 1.0\ntimestep " + dt + "\nfix move all lsm/nve\n";
}

inline const std::string recorded_discs =
    std::string("compute events all lsm/events ledger yes strainlimit 10\n") + disc_columns;

/// A chain of discs along x whose links are of type 1 and 2 in turn, and whose last disc is pulled.
inline std::string two_link_types(int count) {
  std::vector<std::pair<std::string, std::string>> centres;
  for (int n = 0; n < count; ++n) centres.emplace_back(std::to_string(2 * n - count), "0");
  std::string text = discs(centres, 2);
  for (int n = 1; n < count; ++n)
    text += "create_bonds single/bond " + std::to_string(n % 2 ? 1 : 2) + " " + std::to_string(n) +
            " " + std::to_string(n + 1) + "\n";
  return "variable ratio index 1.02\n" +
         linked(text, "bond_coeff 1 1.0\nbond_coeff 2 1.0 ${ratio}\n", "0.02") + "group last id " +
         std::to_string(count) + "\n" + recorded_discs;
}

inline const std::string lattice_of_41 =
    "create_lsm_fault lattice length 41 width 16 spacing 1.0 mass r2 4.0";

/// A fault in a lattice between absorbing borders, in which a patch of higher stress breaks.
/// \param begin  how particles come
/// \param links, across, contacts  more coefficients, of links of type 1, 2 and of contacts
inline std::string lattice_fault(const std::string &begin = lattice_of_41,
                                 const std::string &box = "f f p", const std::string &links = "",
                                 const std::string &across = "", const std::string &contacts = "") {
  return "variable newton index off\nunits lj\ndimension 2\nboundary " + box +
         "\nnewton ${newton}\natom_style hybrid bond sphere\n"
         "atom_modify map array\nspecial_bonds lj/coul 0 1 1\n" +
         begin +
         "\ncomm_modify mode single cutoff 1.8\nneighbor 0.1 bin\n"
         "group lower type 3\ngroup upper type 4\ngroup caps type 5 6\n"
         "bond_style lsm/linked\nbond_coeff 1 1.0" +
         links + "\nbond_coeff 2 0.5" + across +
         "\npair_style lsm/friction slip-weakening\npair_coeff * * off\n"
         "pair_coeff 3 4 1.0 10.0 mu 0.5 mu_static 0.7 dc 3e-4" +
         contacts +
         "\nvariable shear atom 6e-4+1.2e-4*(abs(x)<4)\n"
         "fix load all lsm/traction lower upper 1e-3 v_shear\n"
         "fix caps caps lsm/absorb y 1.2 0.7 1.0\nfix move all lsm/nve\ntimestep 0.1\n"
         "compute events all lsm/events ledger yes progress no\n"
         "thermo_style custom step ke c_events[6] c_events[11] c_events[12] c_events[13] "
         "c_events[15] c_events[16]\n"
         "thermo_modify norm no format float %.17g\nthermo 100\n";
}

}  // namespace physics

#endif
