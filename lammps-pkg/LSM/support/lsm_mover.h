// SPDX-License-Identifier: GPL-2.0-or-later
// What moves particles of the package, to be asked by what looks at them,
// and how far they move from one step of a run to the next

#ifndef LMP_LSM_MOVER_H
#define LMP_LSM_MOVER_H

#include "lmptype.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class Modify;

/// Base of the fixes that move particles. They may put off the second half of a step to the first
/// half of the next, so that both go through memory together or messages travel meanwhile: who
/// looks at velocities calls complete_steps() before.
class LSMMover {
 public:
  virtual ~LSMMover() noexcept(false) {}    // as LAMMPS' own base classes

  /// Velocities and positions of the same time from now on.
  virtual void complete_step() = 0;
  /// Whether the second half of the last step is still to be done.
  bool has_put_off() const { return pending; }
  /// Bits of the groups that it moves.
  virtual int moved_bits() const = 0;
  /// It moved no particle of this rank farther in this step; infinite if that is not known.
  virtual double longest_move() const = 0;

  static void complete_steps(Modify *);

 protected:
  bool pending = false;
};

/// The largest displacement of a particle of this rank in a step, as told by the fixes that move
/// them: they have the velocities at hand, while comparing positions with older ones would read
/// both from memory.
class LSMTravel : protected Pointers {
 public:
  LSMTravel(LAMMPS *_lmp) : Pointers(_lmp) {}
  /// To be called once in each step, after particles have moved. Bound of the displacement of any
  /// particle of this rank since the last call; infinite if unknown, as something else may have
  /// moved particles.
  double since_last();

 private:
  bool known = false;    // all that move particles are these
  std::vector<LSMMover *> movers;
  bigint step = -1, first_step = -1;    // of the last call and of its run

  void look_for_movers();
};

}    // namespace LAMMPS_NS

#endif
