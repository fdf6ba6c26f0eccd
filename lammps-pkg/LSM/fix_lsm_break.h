// SPDX-License-Identifier: GPL-2.0-or-later
// Internal helper of bond style lsm/linked: removes broken links from the
// topology of every rank, so that their particles become contact pairs

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_BREAK,FixLSMBreak);
// clang-format on
#else

#ifndef LMP_FIX_LSM_BREAK_H
#define LMP_FIX_LSM_BREAK_H

#include "lsm_fix_state.h"

namespace LAMMPS_NS {

class FixLSMBreak : public LSMKeptFix<FixLSMBreak> {
 public:
  FixLSMBreak(class LAMMPS *, int, char **);
  int setmask() override { return FixConst::PRE_REVERSE; }
  void init() override;
  void setup_pre_reverse(int eflag, int vflag) override { pre_reverse(eflag, vflag); }
  void pre_reverse(int, int) override;
  double compute_scalar() override { return static_cast<double>(total); }
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.raw(self.total);
  }

 private:
  class BondLSMLinked *links = nullptr;
  bigint total = 0;    // links broken so far, all ranks

  void remove(const std::vector<tagint> &);
};

}    // namespace LAMMPS_NS

#endif
#endif
