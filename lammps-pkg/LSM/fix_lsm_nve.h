// SPDX-License-Identifier: GPL-2.0-or-later
// Velocity Verlet for the Lattice Solid Model with optional viscosity

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/nve,FixLSMNVE);
// clang-format on
#else

#ifndef LMP_FIX_LSM_NVE_H
#define LMP_FIX_LSM_NVE_H

#include "lsm_fix_state.h"
#include "lsm_mover.h"

namespace LAMMPS_NS {

class FixLSMNVE : public LSMKeptFix<FixLSMNVE>, public LSMMover {
 public:
  FixLSMNVE(class LAMMPS *, int, char **);
  ~FixLSMNVE() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void setup_post_neighbor() override { collect(); }
  void post_neighbor() override { collect(); }
  void setup_pre_force(int) override;
  void pre_force(int) override;
  void post_run() override;
  void reset_dt() override;
  /// Highest frequency and stability limit found at setup; the scalar is the work lost to
  /// viscosity.
  double compute_vector(int n) override { return n == 0 ? omega : dt_limit; }
  void restart(char *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

  bool record_work = false;       // set by compute lsm/events when it keeps the energy ledger
  double work_viscosity = 0.0;    // work lost to viscosity, this rank, accumulated
  void complete_step() override;
  int moved_bits() const override { return groupbit; }
  void add_longest_moves(std::vector<double> &of_blocks) const override;
  void raise_viscosity(double least);    // temporarily, to at least this; 0: as given
  std::string viscosity() const;         // one value, or one per type
  double decay_in_half_step(int type) const { return decay[type]; }    // of the velocity
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    state.sum(self.work_viscosity);
  }

 private:
  enum { ERROR, WARN, OFF };
  double nu_least = 0.0;        // nu is temporarily raised to this
  std::vector<double> nu;       // force -nu m v, one value per type
  std::vector<double> decay;    // factor of the velocities in half a step of viscosity, per type
  bool viscous = false;         // some nu is not 0
  double dtv = 0.0, dtf = 0.0;
  int check = ERROR;            // what to do when the time step is above the stability limit
  double omega = 0.0;           // bound of the highest frequency found at setup
  double dt_limit = 0.0;        // of a stable time step, 0 if there is none
  bool continued = false;       // after another run, or from a restart file
  bool is_set_up = false;       // since the last init
  std::vector<double> alone;    // symmetric matrix of each particle: xx yy zz xy yz zx

  // particles of the group with the same viscosity that are contiguous in memory and in one block
  // (see LSMMover), and dt/2 over the mass of every particle

  struct Stretch {
    int first, last;
    double decay;
    double fastest;    // square of the largest velocity in this step, infinite if it is not known
  };
  std::vector<Stretch> stretches;
  std::vector<double> half_kick;

  // Forces are set to 0 while they are in the cache, as the particles move, instead of by the
  // integrator afterwards, unless something may read them in between or needs torques

  bool clears = false;
  std::vector<std::pair<int, int>> others;    // particles between the stretches: first, last

  enum { FINAL = 1, INITIAL = 2 };    // halves of a step
  std::vector<Fix *> velocity_readers;
  class FixLSMVelocity *ahead = nullptr;    // needs velocities at the time of the next forces
  void (FixLSMNVE::*initial_chosen)() = nullptr;
  void (FixLSMNVE::*final_chosen)() = nullptr;
  void (FixLSMNVE::*both_chosen)() = nullptr;    // null if no half may be deferred

  bool counts_work() const { return record_work && (viscous || nu_least > 0.0); }
  enum Kind { PLAIN, AHEAD, ANY };    // nothing else, extrapolated velocities, that and work
  template <int PARTS, int DIM, Kind KIND, bool CLEARS> void move();
  template <int DIM, Kind KIND, bool CLEARS> void set_kernels();
  template <int DIM> void choose_for();
  void choose();
  void collect();
  bool may_clear() const;
  void leave_clearing_to_integrator();
  void clear_all();
  double time_step_limit(double reach_factor, double &frequency);
  double largest_eigenvalue(double reach_factor, bool viscous);
  double largest_eigenvalue(double reach_factor, bool viscous, double power);
};

}    // namespace LAMMPS_NS

#endif
#endif
