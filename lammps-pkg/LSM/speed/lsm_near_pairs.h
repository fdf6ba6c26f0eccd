// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs of a neighbor list that may touch soon

#ifndef LMP_LSM_NEAR_PAIRS_H
#define LMP_LSM_NEAR_PAIRS_H

#include "lsm_contacts.h"
#include "lsm_energy.h"
#include "lsm_list_patch.h"
#include "lsm_travel.h"
#include "lsm_type_pairs.h"

#include <vector>

namespace LAMMPS_NS {
class NeighList;

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

/// Most pairs in the neighbor list of a dense block never touch. This class keeps the pairs that
/// may come near before particles have moved by a small skin against each other, and in each step
/// finds those of them that touch. No pair is missed. It also holds the states of contacts, from
/// when a pair is chosen until others are.
class LSMNearPairs : public LSMContacts {
 public:
  explicit LSMNearPairs(LAMMPS *lmp) : lmp_(lmp), patch(lmp), travel(lmp) {}

  /// How far particles may move against each other until pairs are chosen anew.
  static constexpr double SKIN = 0.05;

  /// To be called before each run.
  /// \param active     which types of particles interact
  /// \param screened   whether the list holds pairs that must not interact
  /// \param sides      where the fault is
  void init(const LSMTypePairs<int> &active, bool screened, const LSMEnergySource &sides);
  /// The same for contacts that have a state, see friction_contact.h.
  /// \param reach      up to this distance, in sums of radii, pairs without contact have one, too
  void keep_states(LSMContactStore &, int state_size, double reach);
  /// Brings everything to this step. To be called once in each, before forces are evaluated.
  void update(NeighList &, const double *radius);
  /// The states of this step have been evaluated.
  void states_changed() { written = false; }
  /// Writes states into the store, if they have changed. To be called before it is read.
  void write_states();
  /// Forgets all, for a list of another kind, or because the store has changed.
  void forget() { build_number = -1; }
  bool is_empty() const { return build_number < 0; }
  /// Finds again which pairs are across the fault, for groups that change.
  void find_sides();
  /// Whether a pair must not interact, for lists that hold such pairs.
  bool is_left_out(int place) const;

 private:
  enum class Due { nothing, strays, choice, new_list };    // see due()
  struct Listed {
    int i, jj, j;
  };

  LAMMPS *const lmp_;
  LSMListPatch patch;
  LSMTravel travel;
  const LSMTypePairs<int> *active = nullptr;
  const LSMEnergySource *sides = nullptr;
  bool screened = false;
  NeighList *list = nullptr;
  const double *radius = nullptr;

  LSMContactStore *store = nullptr;
  int stored_size = 0;         // of a state
  double state_reach = 0.0;    // in sums of radii
  bool written = true;         // the store is up to date
  bigint states_build = -1;    // number of the build of the list that the states belong to
  int known_states = 0;        // pairs whose states were read

  std::vector<Listed> listed;      // the whole neighbor list, and behind it what was added since
  std::vector<char> is_kept;       // of each listed pair
  bigint build_number = -1;        // number of the build of the list
  std::vector<double> x_chosen;    // positions when the pairs were chosen, those of strays later
                                   // ones; empty where all pairs are kept
  std::vector<double> moved;       // bounds of displacements since then, without those of strays
  // The few particles, ghosts among them, that have moved so far since the pairs were chosen that
  // all of their pairs are kept; their motion does not matter then.
  std::vector<int> strays;
  size_t admitted = 0;                    // strays all of whose pairs are kept
  std::vector<int> first_of, pairs_of;    // listed pairs of each particle, once there are strays
  std::vector<int> chosen;                // of no use outside of choose()

  Due due(const double *x);
  void choose(const double *x);
  void read_states();
  void keep_pairs_of_strays();
  double displacement(const double *x, size_t first, size_t last) const;
  void hold_strays(const double *x);
  bool find_strays(const double *x, size_t first, size_t last);
  void index_listed();
  void keep(int n, bool touching);
  int side_of(int i, int j) const;
};

}    // namespace LAMMPS_NS

#endif
