// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: two rigid driving plates

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/plates,FixLSMPlates);
// clang-format on
#else

#ifndef LMP_FIX_LSM_PLATES_H
#define LMP_FIX_LSM_PLATES_H

#include "lsm_fix_state.h"
#include "lsm_mover.h"

namespace LAMMPS_NS {

class FixLSMPlates : public LSMKeptFix<FixLSMPlates>, public LSMMover {
 public:
  FixLSMPlates(class LAMMPS *, int, char **);
  ~FixLSMPlates() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_post_neighbor() override { post_neighbor(); }
  void post_neighbor() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override { complete_step(); }
  double compute_scalar() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  void complete_step() override;
  int moved_bits() const override { return plate[0].bit | plate[1].bit; }
  void add_longest_moves(std::vector<double> &of_blocks) const override
  {
    for (double &move : of_blocks) move += longest;
  }

  double loading = 1.0;    // present factor of the driving velocity, set by fix lsm/leap
  double driving_velocity() const { return speed; }
  // the settings in effect, for headers
  std::vector<std::pair<std::string, std::string>> settings() const;
  // energy of the motion of the plates across the fault
  double kinetic() const { return plate[0].kinetic() + plate[1].kinetic(); }
  template <class Self, class State> static void visit(Self &self, State &state)
  {
    auto &lower = self.plate[0], &upper = self.plate[1];
    state(self.elapsed, self.ux, lower.uy, upper.uy, lower.vy, upper.vy);
    state.sum(self.work_mine);
  }

 private:
  struct Plate {
    int group, bit;
    double side;          // -1 lower, +1 upper
    double mass = 0.0;    // mass of all particles of the plate
    double vy = 0.0;      // velocity across the fault
    double uy = 0.0;      // displacement across the fault since the fix was made
    double fx = 0.0,
           fy = 0.0;    // force of the block on the plate: fx this rank, fy all ranks with servo
    std::vector<int> atoms;                                    // this rank's particles
    double kinetic() const { return 0.5 * mass * vy * vy; }    // of the motion across the fault
  };
  Plate plate[2];

  double speed = 0.0;          // driving velocity of each plate after the ramp
  double ramp = 0.0;           // time over which it is reached
  bool servo = false;          // normal stress held, or position held
  double stress = 0.0;         // normal stress after its ramp
  double stress_ramp = 0.0;    // time over which it is reached
  double damping = 0.0;        // -damping * mass * vy on each plate with servo
  double impedance = 0.0;      // -impedance * length * vy on each plate with servo
  bool vy_known = false;       // velocities across the fault were set by a former run or a restart
  double elapsed = 0.0;        // time since the fix was made
  double ux = 0.0;             // shear displacement of each plate
  double work_mine = 0.0;      // this rank's part of the work

  std::vector<class FixLSMNVE *> integrators;
  class FixLSMVelocity *ahead = nullptr;    // needs velocities at the time of the next forces
  bool reducing = false;                    // a sum of forces across the fault is in transit
  MPI_Request request;
  double across_mine[2], across[2];    // these forces, of this rank and of all
  double moved = 0.0, along = 0.0;     // shear displacement and velocity of the last step
  double longest = 0.0;                // largest displacement of the last step

  tagint in_both(int some, int others) const;
  double half_kick(const Plate &p) const;
  void damp(Plate &p);
  double decay_of(const Plate &p) const;
  double area() const;
  double velocity_at(double t) const;
  double stress_at(double t) const;
  void start_sum();
  void finish_sum();
  void finish_step();
};

}    // namespace LAMMPS_NS

#endif
#endif
