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

namespace LSM {
struct FaceDisplacement;
}

namespace LAMMPS_NS {

class FixLSMRecord : public LSMKeptFix<FixLSMRecord> {
 public:
  FixLSMRecord(class LAMMPS *, int, char **);
  ~FixLSMRecord() override;
  int setmask() override
  {
    return FixConst::PRE_EXCHANGE | FixConst::END_OF_STEP | FixConst::POST_RUN;
  }
  void setup(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override;
  void write_restart(FILE *) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.list(self.saved_state);
  }

  /// Stores the positions of this rank's particles on the faces of the fault, from which their
  /// displacements are measured later.
  void begin_faces();
  /// Step in which they were stored; below 0 before the first.
  bigint faces_since() const { return since; }
  /// Displacements since then of the particles of two groups, given by their bits.
  std::vector<LSM::FaceDisplacement> faces(int lower, int upper) const;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  double memory_usage() override;

  class ComputeLSMEvents *owner = nullptr;    // set by the compute that made this fix
  std::vector<double>
      saved_state;    // state of the compute in the last restart file, read or written

 private:
  // stored x of each particle, in three dimensions followed by z; null if the faces are not needed
  double *x_before = nullptr;
  int directions = 1;    // numbers of a particle
  bigint since = -1;     // step in which it was stored
};

}    // namespace LAMMPS_NS

#endif
#endif
