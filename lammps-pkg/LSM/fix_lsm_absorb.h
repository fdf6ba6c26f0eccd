// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: border that absorbs P- and S-waves

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/absorb,FixLSMAbsorb);
// clang-format on
#else

#ifndef LMP_FIX_LSM_ABSORB_H
#define LMP_FIX_LSM_ABSORB_H

#include "fix.h"
#include "lsm_energy.h"

namespace LAMMPS_NS {

class FixLSMAbsorb : public Fix, public LSMWorkSource {
 public:
  FixLSMAbsorb(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  double dashpot[2];    // force over velocity along x and y, of each particle
  double rate;          // energy lost per time in the last step, this rank

  void add_forces(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
