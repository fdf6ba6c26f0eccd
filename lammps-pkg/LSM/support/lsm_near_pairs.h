// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs of a neighbor list that may touch soon

#ifndef LMP_LSM_NEAR_PAIRS_H
#define LMP_LSM_NEAR_PAIRS_H

#include "lmptype.h"

#include <limits>
#include <vector>

namespace LAMMPS_NS {

class NeighList;

/// Most pairs in the neighbor list of a dense block never touch. This class keeps the pairs that
/// may come near before particles have moved by a small skin against each other, and in each step
/// finds those of them that touch. No pair is missed.
class LSMNearPairs {
 public:
  struct Pair {
    int i, jj;    ///< a particle, and the index of its partner in its neighbors
  };

  /// How far particles may move against each other until pairs are chosen anew.
  static constexpr double SKIN = 0.05;
  /// What has to be done before find(): nothing, keep_pairs_of_strays(), choose(), or choose() from
  /// a list that was built since.
  enum class Due { nothing, strays, choice, new_list };
  /// To be called once in each step.
  /// \param build     number of the build of the neighbor list
  /// \param x         positions of all particles with ghosts, `count` of them, `nlocal` without
  /// \param moves     bounds of displacements since the last call, see LSMTravel
  Due due(bigint build, const NeighList &, const double *x, int nlocal, int count,
          const std::vector<double> &moves);
  /// Chooses the pairs that are kept.
  /// \param reach     pairs are near up to this distance, in sums of radii
  /// \param touch     flags of pairs that are kept and given at any distance, as in the neighbor
  /// list, or null
  void choose(const double *x, const double *radius, double reach, const int *const *touch);
  /// Whether strays are looked for: not if so few pairs are listed that all of them are kept.
  bool knows_strays() const { return !held.empty(); }
  /// The few particles, ghosts among them, that have moved so far since the pairs were chosen that
  /// all of their pairs are kept; their motion does not matter then.
  const std::vector<int> &strays() const { return found_strays; }
  /// Adds the pairs of new strays to those that are kept.
  void keep_pairs_of_strays(const double *radius);
  /// Keeps a pair that was added to the neighbor list.
  void add(int i, int jj, int j, const double *radius);
  /// Finds the kept pairs that touch.
  void find(const double *x);
  /// The pairs that are kept: in the order of the neighbor list those that were chosen, then those
  /// that were added.
  const std::vector<Pair> &kept() const { return pairs; }
  /// Number of kept pairs that touch, or nearly do because of rounding, and the index in kept() of
  /// the n-th of these, in the same order.
  int size() const { return number; }
  int operator[](int n) const { return found[n]; }
  /// From the second to the first particle of a pair, by its place in kept(), along x and y: now,
  /// and in the step before; the latter only if the pair was kept then.
  const double *vector(int place) const { return &vectors[newest][2 * place]; }
  const double *vector_before(int place) const { return &vectors[1 - newest][2 * place]; }
  /// Whether a pair is found at any distance. The caller has to report changes of this.
  bool is_touching(int place) const
  {
    return limit[place] == std::numeric_limits<double>::infinity();
  }
  void set_touching(int place, bool yes)
  {
    limit[place] = yes ? std::numeric_limits<double>::infinity() : within[place];
  }
  /// Forgets all, for a list of another kind.
  void clear() { built = -1; }

 private:
  struct Ends {
    int i, j;    // indices of their coordinates
  };
  struct Listed {
    int i, jj, j;
  };
  std::vector<Listed> listed;    // the whole neighbor list, and behind it what was added since
  std::vector<char> is_kept;     // of each listed pair
  std::vector<Pair> pairs;
  std::vector<Ends> ends;        // this and the following have an entry per pair
  std::vector<double> within;    // square of the distance up to which a pair touches
  std::vector<double> limit;     // the same, infinite where it is given at any distance
  std::vector<double> vectors[2];
  int newest = 0;
  std::vector<int> found;    // the first `number` of them touch now
  int number = 0;

  bigint built = -1;
  std::vector<double> held;     // positions when the pairs were chosen, those of strays later ones;
                                // empty where all pairs are kept
  std::vector<double> moved;    // bounds of displacements since then, without those of strays
  std::vector<int> found_strays;
  size_t admitted = 0;                    // strays all of whose pairs are kept
  std::vector<int> first_of, pairs_of;    // listed pairs of each particle, once there are strays

  double displacement(const double *x, size_t first, size_t last) const;
  void hold_strays(const double *x);
  bool find_strays(const double *x, size_t first, size_t last);
  void index_listed();
  void keep(int n, const double *radius, bool touching);
};

}    // namespace LAMMPS_NS

#endif
