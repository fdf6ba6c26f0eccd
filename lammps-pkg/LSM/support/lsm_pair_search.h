// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS' search for pairs of discs, with vectors

#ifndef LMP_LSM_PAIR_SEARCH_H
#define LMP_LSM_PAIR_SEARCH_H

#include "npair.h"

#include <memory>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Takes the place of LAMMPS' own search (half list, newton off, radii, molecules), and writes the
/// same list, entry by entry. Those that can be in it are found eight at a time; what it
/// does not know (exclusions, templates of molecules, three dimensions) it leaves to the other.
class LSMPairSearch : public NPair {
 public:
  /// To be called once the list was built: from the next time on it is built by this search, if
  /// it is of that kind.
  static void take_over(class LAMMPS *, class NeighList &);

  void copy_neighbor_info() override;
  void build(class NeighList *) override;

 private:
  LSMPairSearch(class LAMMPS *, NPair *other);

  std::unique_ptr<NPair> stock;

  // particles in the order of their bins

  std::vector<int> begin;     // of each bin, and the end of the last
  std::vector<int> number;    // the particle
  std::vector<float> place[2], size;
  std::vector<std::pair<int, int>> rows;    // of the stencil: bins that follow each other
  std::vector<int> found;

  void sort_particles();
  int find(int i, float xi, float yi, float reach);
};

}    // namespace LAMMPS_NS

#endif
