/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   How far particles move from one step of a run to the next
------------------------------------------------------------------------- */

#ifndef LMP_LSM_TRAVEL_H
#define LMP_LSM_TRAVEL_H

#include "lmptype.h"
#include "lsm_mover.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/// The longest way of a particle of this rank in a step, as told by the fixes that move them: they have the velocities
/// at hand, while comparing positions with older ones reads both from memory.
class LSMTravel : protected Pointers {
 public:
  LSMTravel(LAMMPS *_lmp) : Pointers(_lmp) {}
  /// To be called once in each step, after particles have moved. No particle of this rank has moved farther since the
  /// last call; infinite if that is not known, as something else may have moved particles.
  /// \param wanted  whether the fixes are to measure it from the next step on
  double since_last(bool wanted);

 private:
  bool known = false;    // all that move particles are these
  std::vector<LSMMover *> movers;
  bigint step = -1, first_step = -1;    // of the last call and of its run

  void look_for_movers();
};

}    // namespace LAMMPS_NS

#endif
