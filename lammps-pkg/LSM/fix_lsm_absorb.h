// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: border that absorbs P- and S-waves

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/absorb,FixLSMAbsorb);
// clang-format on
#else

#ifndef LMP_FIX_LSM_ABSORB_H
#define LMP_FIX_LSM_ABSORB_H

#include "lsm_energy.h"
#include "lsm_fix_state.h"

namespace LAMMPS_NS {

class FixLSMAbsorb : public LSMKeptFix<FixLSMAbsorb>, public LSMWorkSource {
 public:
  FixLSMAbsorb(class LAMMPS *, int, char **);
  int setmask() override { return FixConst::POST_FORCE; }
  void init() override;
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.sum(self.work_absorbed);
  }

 private:
  double dashpot[3];    // force over velocity of each particle, along the axes
  bool of_mass;         // the same over mass
  double rate = 0.0;    // energy lost per time in the second half of the last step, this rank
  std::vector<FixLSMAbsorb *> borders;    // all fixes of this style, and all that integrate
  std::vector<class FixLSMNVE *> integrators;

  double drag(int i, int c, double mass) const;
  template <int DIM> void absorb();
};

}    // namespace LAMMPS_NS

#endif
#endif
