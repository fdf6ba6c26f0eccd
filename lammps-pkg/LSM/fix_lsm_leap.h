// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: leaps between events (*)

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/leap,FixLSMLeap);
// clang-format on
#else

#ifndef LMP_FIX_LSM_LEAP_H
#define LMP_FIX_LSM_LEAP_H

#include "lsm_fix_state.h"

#include <deque>

namespace LSM {
struct Keyword;
}

namespace LAMMPS_NS {

class FixLSMLeap : public LSMKeptFix<FixLSMLeap> {
 public:
  FixLSMLeap(class LAMMPS *, int, char **);
  ~FixLSMLeap() override;
  int setmask() override { return FixConst::END_OF_STEP; }
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void reset_dt() override;
  double compute_scalar() override;
  double compute_vector(int) override;

  double model_time(bigint step) const;    // at one of the last steps
  // asks for the model time of so many of the last steps
  void keep(bigint steps) { kept = MAX(kept, steps); }
  std::string settings();    // for headers of files
  double fastest() const { return fast; }
  template <class Self, class State> static void visit(Self &, State &);

 private:
  enum { EVENT, SETTLE, LEAP };

  // settings

  std::string plates_id;
  double fast = 0.00025;    // driving velocity while nothing slips
  // bound of the rate of slip moment, relative to that of the whole fault at the fast velocity,
  // above which there is an event
  double slip = 0.5;
  double calm = 10.0;    // time without such slip after which the blocks settle
  // bound of the kinetic energy, relative to that of the loading motion at the fast velocity, below
  // which the blocks are at rest
  double rest = 10.0;
  double viscosity = 0.0;    // least viscosity while the blocks settle; 0: no more than always
  double ramp = 15.0;        // time from the slow to the fast velocity
  double grow = 0.0;         // model time in which the factor rises by 1; 0: as fast as the ramp
  double between = 1.5;      // time between two checks

  class FixLSMPlates *plates = nullptr;
  std::vector<class FixLSMNVE *> integrators;
  std::vector<class PairLSMFriction *> contacts;
  double dt, loading_energy = 0.0;
  bigint kept = 20000;    // steps for which changes of the rate are kept
  bigint looked = 0;      // step of the last check, or of the beginning of the run

  // state; the model time is extrapolated from the last change of its rate

  struct Change {
    bigint step;
    double time, rate;    // rate: model time per step
    template <class Self, class State> static void visit(Self &self, State &state)
    {
      state(self.step, self.time, self.rate);
    }
  };
  std::deque<Change> changes;
  int state = EVENT;
  double factor = 1.0;        // present factor of the driving velocity
  double since = 0.0;         // time since the last slip above the bound
  double steps_time = 0.0;    // time of the steps done under this fix
  double leap_time = 0.0;     // part of this time while leaping
  double stops = 0.0;         // number of leaps that ended
  bool begun = false;         // the time step is fixed

  std::vector<LSM::Keyword> keywords();
  double time_of_steps() const;
  bool leaps() const;    // the plates are driven, and more slowly than the fast velocity
  void set_factor(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
