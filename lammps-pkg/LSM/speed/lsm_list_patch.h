// SPDX-License-Identifier: GPL-2.0-or-later
// Adds the pairs of single particles to a neighbor list that is in use

#ifndef LMP_LSM_LIST_PATCH_H
#define LMP_LSM_LIST_PATCH_H

#include "lsm_type_pairs.h"
#include "pointers.h"

#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

/// LAMMPS builds all neighbor lists anew once any particle has moved by half the skin. In a dense
/// block this is mostly a single disc that has snapped into another place. This class adds the
/// pairs of such a disc to the list instead, and notes its position for LAMMPS' own check of
/// distances, so that the list is as good as a new one. Particles may move by half of what the
/// ghosts reach farther than listed pairs (comm_modify cutoff), and by less than a sub-domain. If
/// that is too little, or if others use neighbor lists or may rely on the skin, everything is left
/// to LAMMPS.
class LSMListPatch : protected Pointers {
 public:
  LSMListPatch(LAMMPS *_lmp) : Pointers(_lmp) {}

  struct Added {
    int i, jj, j;    ///< a particle, the index of its partner in its neighbors, and the partner
  };

  /// To be called when pairs are chosen from a list for the first time. Pairs are added to it from
  /// then on, if it was built in this step.
  /// \param active  which types of particles interact
  void start(NeighList &, const LSMTypePairs<int> &active);
  /// Adds the pairs of those of these particles that have moved far.
  /// \return the pairs added, until the next call
  const std::vector<Added> &look_at(const std::vector<int> &particles);
  /// The same for all particles from local index `first` on, ghosts included.
  const std::vector<Added> &look_at_all(int first);
  /// Nothing is added until the next start().
  void stop() { list = nullptr; }

 private:
  NeighList *list = nullptr;    // null while nothing can be added
  const LSMTypePairs<int> *active = nullptr;
  double margin = 0.0;             // a particle whose pairs were added is nearer to x_build
  double trigger_sq = 0.0;         // square of the displacement from which pairs are added
  std::vector<double> x_build;     // positions when the list was built
  std::vector<double> x_listed;    // the same, later ones where pairs were added
  bool wants_build = false;        // LAMMPS has to build all lists
  bool may_be_refreshed =
      false;    // positions may have been refreshed since the last build, on any rank
  std::vector<int> far;
  std::vector<Added> added;
  // Particles by the square cell, along x and y, in which they were when the list was built. Sorted
  // when a pair is added for the first time.
  double cell = 0.0, corner[2] = {};
  int cells[2] = {};
  std::vector<int> first_in, sorted;
  std::unordered_map<int, std::vector<int>> rows;    // of the list, where pairs were added

  double find_margin(const NeighList &) const;
  bool is_far(int) const;
  const std::vector<Added> &add_pairs_of_far();
  void ask_for_build();
  void sort_into_cells();
  int find_cell(const double *position) const;
  void add_pairs_of(int);
  void add_pair(int, int);
  bool is_excluded(int i, int j) const;
  bool is_listed(int i, int j) const;
};

}    // namespace LAMMPS_NS

#endif
