// SPDX-License-Identifier: GPL-2.0-or-later
// The fixes of the package that move particles

#ifndef LMP_LSM_MOVER_H
#define LMP_LSM_MOVER_H

#include "lsm_fixes.h"

#include <vector>

namespace LAMMPS_NS {

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

  static void complete_steps(Modify *modify)
  {
    for (auto *mover : lsm_fixes<LSMMover>(modify)) mover->complete_step();
  }

 protected:
  bool pending = false;
};

}    // namespace LAMMPS_NS

#endif
