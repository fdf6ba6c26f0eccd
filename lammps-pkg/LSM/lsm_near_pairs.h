/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Pairs of a neighbor list that may touch soon
------------------------------------------------------------------------- */

#ifndef LMP_LSM_NEAR_PAIRS_H
#define LMP_LSM_NEAR_PAIRS_H

#include "lmptype.h"

#include <vector>

namespace LAMMPS_NS {

class NeighList;

/// Most pairs in the neighbor list of a filled block never touch. Looked at in each step are those that may come within reach before particles have moved by a small skin
/// against each other: no pair is missed, so forces are the same to the last bit.
class LSMNearPairs {
 public:
  /// Pairs of i: places in its part of the neighbor list, from pairs[first] to before pairs[last], as they stand there.
  struct Particle {
    int i, first, last;
  };
  std::vector<Particle> particles;
  std::vector<int> pairs;

  /// Looks for the pairs again where that is needed.
  /// \param build  number of the build of the neighbor list
  /// \param x      positions of all particles with ghosts, `count` of them
  /// \param reach  pairs are within reach up to this distance, in sums of radii
  /// \param touch  flags of pairs to be kept in any case, as in the neighbor list, or null
  void update(bigint build, const NeighList &, const double *x, int count, const double *radius,
              double reach, const int *const *touch);
  /// Forgets all, for a list of another kind.
  void clear() { built = -1; }

 private:
  bigint built = -1;
  std::vector<double> held;    // positions when the pairs were looked for; empty where all are kept

  bool outdated(const double *x) const;
};

}    // namespace LAMMPS_NS

#endif
