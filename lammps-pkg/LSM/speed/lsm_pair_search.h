// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS' search for pairs of discs, with vectors

#ifndef LMP_LSM_PAIR_SEARCH_H
#define LMP_LSM_PAIR_SEARCH_H

#include "npair.h"

#include <memory>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Replaces LAMMPS' own search (half list, newton off, radii, molecules) and writes the same list,
/// entry by entry. Candidates are tested eight at a time. Whatever this search does not support
/// (exclusions, templates of molecules, three dimensions) is left to LAMMPS' own.
class LSMPairSearch : public NPair {
 public:
  /// Lets this search build a list from the next time on, if the list is of that kind. To be called
  /// after the list was built once.
  static void take_over(class LAMMPS *, class NeighList &);

  void copy_neighbor_info() override;
  void build(class NeighList *) override;

 private:
  LSMPairSearch(class LAMMPS *, NPair *other);

  std::unique_ptr<NPair> stock;

  // particles, sorted by their bins

  std::vector<int> begin;     // where each bin begins, and the end of the last
  std::vector<int> number;    // local index of the particle
  std::vector<float> place[2], size;
  std::vector<std::pair<int, int>> rows;    // runs of consecutive bins of the stencil
  std::vector<int> found;

  void sort_particles();
  int find(int i, float xi, float yi, float reach);
};

}    // namespace LAMMPS_NS

#endif
