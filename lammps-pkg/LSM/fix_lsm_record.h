// SPDX-License-Identifier: GPL-2.0-or-later
// Internal helper of compute lsm/events: calls it at every step and keeps
// its state in restart files

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_RECORD,FixLSMRecord);
// clang-format on
#else

#ifndef LMP_FIX_LSM_RECORD_H
#define LMP_FIX_LSM_RECORD_H

#include "lsm_fix_state.h"

#include <vector>

namespace LAMMPS_NS {

class FixLSMRecord : public LSMKeptFix<FixLSMRecord> {
 public:
  FixLSMRecord(class LAMMPS *, int, char **);
  int setmask() override;
  void setup(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override;
  void write_restart(FILE *) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.list(self.kept);
  }

  class ComputeLSMEvents *owner;    // set by the compute that made this fix
  std::vector<double> kept;    // state of the compute in the last restart file, read or written
};

}    // namespace LAMMPS_NS

#endif
#endif
