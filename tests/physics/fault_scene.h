// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault_scene.h
/// A short fault for the physics tests. It is compressed once; all tests shear it from the same
/// data file.
#ifndef LSM_PHYSICS_FAULT_SCENE_H
#define LSM_PHYSICS_FAULT_SCENE_H

#include <string>

#include "lmp_runner.h"

namespace physics {

inline const char *const fault_columns =
    "thermo_style custom step ke c_events c_events[2] c_events[3] c_events[5] c_events[6] "
    "c_events[7] c_events[8] c_events[9] c_events[10] c_events[11] c_events[12] c_events[13] "
    "f_plates f_plates[1] f_plates[2] f_plates[8] f_plates[9]\n"
    "thermo_modify norm no format float %.17g\n";

/// Columns that a restart or another number of ranks must reproduce.
inline const std::vector<std::string> compared = {
    "KinEng",       "c_events[5]",  "c_events[6]",  "c_events[7]", "c_events[8]", "c_events[9]",
    "c_events[10]", "c_events[11]", "c_events[12]", "f_plates[1]", "f_plates[2]", "f_plates[9]"};

inline std::string fault_start() {
  return R"(
variable newton   index off
variable dt       index 0.03
variable mus      index 0.6
variable seed     index 3
units             lj
dimension         2
boundary          p f p
newton            ${newton}
atom_style        hybrid bond sphere
atom_modify       map array
comm_modify       mode single cutoff 3.6
neighbor          0.4 bin
neigh_modify      delay 0 every 10 check yes
special_bonds     lj/coul 0 1 1
)";
}

inline std::string fault_forces() {
  return R"(
bond_style        lsm/linked
bond_coeff        1 1.0
pair_style        lsm/friction
pair_coeff        * * off
pair_coeff        3 4 1.0 1.0 0.6 ${mus}
)";
}

inline std::string fault_groups() {
  return R"(
group             lower type 5
group             upper type 6
group             plates union lower upper
group             blocks subtract all plates
group             below type 1 3 5
group             above type 2 4 6
group             lowerface type 3
group             upperface type 4
)";
}

/// Compresses the fault and writes settled.data.
inline std::string fault_settle() {
  return fault_start() + "create_lsm_fault length 40 width 20 seed ${seed} failures 500\n" +
         fault_groups() + fault_forces() + R"(
timestep          0.03
fix               move blocks lsm/nve viscosity 0.2
fix               plates all lsm/plates lower upper stress 0.006 stressramp 60 damping 0.2
thermo            1000
run               6000
write_data        settled.data nocoeff
)";
}

inline std::string fault_read() {
  return fault_start() + "read_data settled.data\n" + fault_groups() + fault_forces() +
         "timestep ${dt}\n";
}

/// Begins from a restart file of the fault.
inline std::string fault_restart(const std::string &file) {
  return "newton off\natom_style hybrid bond sphere\natom_modify map array\n"
         "comm_modify mode single cutoff 3.6\nread_restart " +
         file + "\nneighbor 0.4 bin\nneigh_modify delay 0 every 10 check yes\n";
}

/// Fixes, compute and thermo output of the shear phase. Events are frequent, as the plates are
/// fast.
inline std::string fault_shear(const std::string &events) {
  return R"(
variable          viscosity index 0.02
variable          velocity index 0.005
fix               move blocks lsm/nve viscosity ${viscosity}
fix               plates all lsm/plates lower upper stress 0.006 damping ${viscosity} velocity ${velocity} ramp 3
compute           events all lsm/events sides below above faces lowerface upperface ledger yes overwrite yes )" +
         events + "\n" + fault_columns;
}

/// Test suite with settled.data in its folder.
class Fault : public Lmp {
 protected:
  static void SetUpTestSuite() {
    Lmp::SetUpTestSuite();
    ran(fault_settle());
  }
};

}  // namespace physics

#endif
