// SPDX-License-Identifier: GPL-2.0-or-later
// Internal helper of viscous links and contacts: velocities of the time at
// which forces are evaluated, and the energy that the dashpots take

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_VELOCITY,FixLSMVelocity);
// clang-format on
#else

#ifndef LMP_FIX_LSM_VELOCITY_H
#define LMP_FIX_LSM_VELOCITY_H

#include "lsm_energy.h"
#include "lsm_fix_state.h"

#include <cstdint>

namespace LAMMPS_NS {

class FixLSMVelocity : public LSMKeptFix<FixLSMVelocity>, public LSMWorkSource {
 public:
  FixLSMVelocity(class LAMMPS *, int, char **);
  ~FixLSMVelocity() override;

  /// The one of this scene for a force style that needs it from its init on; made where there is none.
  static FixLSMVelocity *ask_for(LAMMPS *);
  /// The one of this scene, or null if nobody needs it in this run.
  static FixLSMVelocity *in_use(LAMMPS *);

  /// Velocities of the time of the positions, particles of this rank and ghosts. Between two evaluations of the forces those
  /// that move particles set them: velocities themselves are those of half a step before when forces are evaluated.
  double **now = nullptr;
  /// What the dashpots take in this evaluation, this rank's share: force styles add to it.
  double power = 0.0;

  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void post_integrate() override;
  void pre_force(int) override;
  void post_force(int) override;
  void post_run() override;
  double compute_scalar() override;
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  void write_restart(FILE *) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.sum(self.work_dashpots);
    state.raw(self.known);
  }
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override;
  int size_restart(int) override;

 private:
  bool asked = false, used = false;
  int extrapolated = 0;    // groups of the particles whose velocities are set by who moves them
  double power_before = 0.0;    // of the evaluation before
  std::uint64_t known = 0;      // fingerprint of the velocities that belong to `now`
  std::uint64_t fingerprint() const;
  void take_velocities(int unless);
};

}    // namespace LAMMPS_NS

#endif
#endif
