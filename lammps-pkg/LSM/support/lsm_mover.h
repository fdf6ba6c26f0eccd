// SPDX-License-Identifier: GPL-2.0-or-later
// The fixes of the package that move particles, and how far particles move from one step of a run
// to the next

#ifndef LMP_LSM_MOVER_H
#define LMP_LSM_MOVER_H

#include "lmptype.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class Modify;

/// Base of the fixes that move particles. They may defer the second half of a step to the first
/// half of the next, to save a pass through memory or to hide communication, so that code that
/// reads velocities has to call complete_steps() first.
class LSMMover {
 public:
  virtual ~LSMMover() noexcept(false) {}    // as LAMMPS' own base classes

  /// Brings velocities to the time of the positions.
  virtual void complete_step() = 0;
  /// Whether the second half of the last step is still to be done.
  bool has_put_off() const { return pending; }
  /// Bits of the groups that this fix moves.
  virtual int moved_bits() const = 0;
  /// Number of particles with consecutive local indices that share one bound of displacements.
  static constexpr int BLOCK = 256;
  /// Adds to each element an upper bound of the displacements of the particles of its block in this
  /// step, infinity where none is known.
  virtual void add_longest_moves(std::vector<double> &of_blocks) const = 0;

  static void complete_steps(Modify *);

 protected:
  bool pending = false;
};

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
