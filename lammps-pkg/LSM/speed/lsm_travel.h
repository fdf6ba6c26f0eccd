// SPDX-License-Identifier: GPL-2.0-or-later
// How far particles move from one step of a run to the next

#ifndef LMP_LSM_TRAVEL_H
#define LMP_LSM_TRAVEL_H

#include "lmptype.h"
#include "lsm_mover.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

/// The largest displacements of the particles of this rank in a step, reported by the fixes that
/// move them: they have the velocities at hand, whereas comparing positions with older ones would
/// read both from memory.
class LSMTravel : protected Pointers {
 public:
  LSMTravel(LAMMPS *_lmp) : Pointers(_lmp) {}
  /// To be called once in each step, after particles have moved. Bounds of the displacements since
  /// the last call, one for each block (see LSMMover); infinite if unknown, as something else may
  /// have moved particles.
  const std::vector<double> &since_last();

 private:
  bool known = false;    // nothing but `movers` moves particles
  std::vector<LSMMover *> movers;
  std::vector<double> longest;               // of each block
  bigint step = -1;                          // of the last call
  bigint first_step = -1, last_step = -1;    // of its run

  void look_for_movers();
};

}    // namespace LAMMPS_NS

#endif
