// SPDX-License-Identifier: GPL-2.0-or-later
// Internal helper of viscous links and contacts: velocities of the time at
// which forces are evaluated, beside positions, and the energy that the
// dashpots take

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_VELOCITY,FixLSMVelocity);
// clang-format on
#else

#ifndef LMP_FIX_LSM_VELOCITY_H
#define LMP_FIX_LSM_VELOCITY_H

#include "fix_store_atom.h"
#include "lsm_energy.h"
#include "lsm_fix_state.h"

namespace LAMMPS_NS {

/// Stores velocities at the time of the positions of the particles of this rank and of ghosts, in
/// two dimensions with the positions beside them: see LSMLinkKernel::Motion. The fixes that move
/// particles set them, as LAMMPS' own velocities are half a step old when forces are evaluated.
class FixLSMVelocity : public LSMKeptFix<FixLSMVelocity, FixStoreAtom>, public LSMWorkSource {
 public:
  FixLSMVelocity(class LAMMPS *, int, char **);

  /// Returns the fix of this scene to a force style that needs it, and creates it if necessary.
  /// Force styles call this in their init.
  static FixLSMVelocity *of(LAMMPS *);
  /// Returns the fix of this scene, or null if no style needs it.
  static FixLSMVelocity *in_use(LAMMPS *);

  double *now(int i) const { return astore[i]; }
  /// Sets what is stored of a particle that has been moved.
  void set(int i, const double *velocity);
  /// Rate of the distance r of two particles.
  double rate(int i, int j, double r) const;
  /// This rank's share of the power dissipated by dashpots in this evaluation, to which force
  /// styles add.
  double power = 0.0;

  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void post_integrate() override;
  void pre_force(int) override;
  void post_force(int) override;
  void post_run() override;
  void set_arrays(int) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override { return 4; }
  int size_restart(int) override { return 4; }
  void write_restart(FILE *) override;
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.sum(self.work_dashpots);
    state.raw(self.known);
  }

 private:
  bool used = false;            // a force style is viscous
  bool running = false;         // from the first step of a run to its end
  int extrapolated = 0;         // bits of groups that are set by the fixes that move them
  bool all_may_move = true;     // other fixes may move any of them as well
  std::vector<int> others;      // particles that the fixes do not set, since the last neighbor list
  double power_before = 0.0;    // power in the previous evaluation
  std::uint64_t known = 0;      // fingerprint of the velocities that belong to `now`
  std::uint64_t fingerprint() const;
  void take_velocities();
  void take_position(int);
  void send(bool all);
};

}    // namespace LAMMPS_NS

#endif
#endif
