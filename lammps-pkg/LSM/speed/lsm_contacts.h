// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs of particles that may touch soon, and what is remembered of each

#ifndef LMP_LSM_CONTACTS_H
#define LMP_LSM_CONTACTS_H

#include <cstddef>
#include <limits>
#include <vector>

namespace LAMMPS_NS {

/// Where contacts are kept from one neighbor list to the next: of a pair, given by its first
/// particle and the index of its partner in the neighbors, whether it has a state, and the state.
class LSMContactStore {
 public:
  virtual ~LSMContactStore() noexcept(false) {}    // as LAMMPS' own base classes

  virtual int *touch_of(int i, int jj) = 0;
  virtual double *values_of(int i, int jj) = 0;
  /// Makes room for the pair that was added as entry jj, the last, to the neighbors of particle i.
  virtual void add_pair(int i, int jj) = 0;
};

/// The pairs that LSMNearPairs keeps, by their place: in the order of the neighbor list those that
/// were chosen, then those that were added. In LAMMPS' arrays, what is needed of a contact would be
/// scattered over a dozen cache lines. Knows nothing of LAMMPS.
class LSMContacts {
 public:
  struct Pair {
    int i, j;       ///< particles
    int types;      ///< place of the coefficients of their types, or of their own
    int across;     ///< see LSMEnergySource::across_fault()
    double r0;      ///< sum of the radii
    double size;    ///< effective size of the contact
  };
  /// \param state_size  numbers that are remembered of each pair
  /// \param dimension   of the vectors of the pairs, 2 or 3
  void begin(int state_size, int dimension);
  /// Adds a pair whose state is zero.
  /// \param touching  see is_touching()
  void add(const Pair &, bool touching);
  /// Calculates the vectors of all pairs, and finds those that touch.
  void find(const double *x);

  int count() const { return static_cast<int>(pairs.size()); }
  /// How often all pairs were replaced by others.
  int begun() const { return begun_; }
  const Pair &pair(int place) const { return pairs[place]; }
  /// Number of pairs that touch, or nearly do because of rounding, and the place of the n-th of
  /// these, in the same order.
  int size() const { return number; }
  int operator[](int n) const { return found[n]; }
  /// From the second to the first particle of a pair, in the plane or in
  /// space: now, and in the step before; the latter only if the pair was there then.
  const double *vector(int place) const { return &vectors[newest][dim * place]; }
  const double *vector_before(int place) const { return &vectors[1 - newest][dim * place]; }
  /// Whether a pair is found at any distance.
  bool is_touching(int place) const
  {
    return limit[place] == std::numeric_limits<double>::infinity();
  }
  void set_touching(int place, bool yes)
  {
    limit[place] = yes ? std::numeric_limits<double>::infinity() : within(pairs[place].r0);
  }
  double *state(int place) { return states.data() + static_cast<std::size_t>(place) * state_size; }
  /// The pairs from this place on were added after the last find() but one.
  int kept_before() const { return before; }

 protected:
  struct Ends {
    int i, j;    // indices of their coordinates
  };
  static constexpr double ROUNDING = 1e-9;    // of squares of distances
  static double within(double r0) { return r0 * r0 * (1.0 + ROUNDING); }

  std::vector<Pair> pairs;
  std::vector<Ends> ends;       // what find() reads, for each pair
  std::vector<double> limit;    // square of the distance up to which a pair is found
  std::vector<double> vectors[2];
  std::vector<double> states;
  int state_size = 0, dim = 2, newest = 0;
  int before = 0, at_last_find = 0;
  std::vector<int> found;    // the first `number` of them touch now
  int number = 0;

 private:
  int begun_ = 0;

  template <int DIM> void find_in(const double *x);
};

}    // namespace LAMMPS_NS

#endif
