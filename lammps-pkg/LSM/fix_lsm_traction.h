// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: initial normal and shear traction of a flat fault

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/traction,FixLSMTraction);
// clang-format on
#else

#ifndef LMP_FIX_LSM_TRACTION_H
#define LMP_FIX_LSM_TRACTION_H

#include "lsm_energy.h"
#include "lsm_fix_state.h"

namespace LAMMPS_NS {

class FixLSMTraction :
    public LSMKeptFix<FixLSMTraction>,
    public LSMWorkSource,
    public LSMContactRadii {
 public:
  FixLSMTraction(class LAMMPS *, int, char **);
  ~FixLSMTraction() override;
  void post_constructor() override;
  int setmask() override
  {
    return FixConst::PRE_NEIGHBOR | FixConst::PRE_FORCE | FixConst::POST_FORCE;
  }
  void init() override;
  void setup_pre_neighbor() override { pre_neighbor(); }
  void pre_neighbor() override;
  void setup_pre_force(int) override;
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int) override;
  const double *contact_radii() const override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.sum(self.work_outside);
    state(self.begun);
  }

 private:
  enum { NORMAL, SHEAR, DIP, ADDED };
  int side[2];    // group bits of the lower and the upper face
  // normal, shear, shear along z, shear added in each step: number or v_name
  std::string traction[4] = {"", "", "0", "0"};
  int spaced = 0;                      // 1: particles are loaded by their spacing, not diameter
  double per_mass = 0.0;               // length or area that they represent, over mass; 0: not so
  double widest_radius = 0.0;          // of the faces, while contacts are loaded
  bool begun = false;                  // the contacts have been loaded
  double *contact_radius, *load[3];    // of each particle; load: force of the other face

  void find_store();
  std::vector<double> evaluate(const std::string &) const;
  int partner(int, const std::vector<int> &) const;
  double share_of(int) const;
  std::vector<double> shares(int) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
