// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs of a neighbor list that may touch soon

#ifndef LMP_LSM_NEAR_PAIRS_H
#define LMP_LSM_NEAR_PAIRS_H

#include "lsm_contacts.h"
#include "lsm_energy.h"
#include "lsm_list_patch.h"
#include "lsm_travel.h"
#include "lsm_type_pairs.h"

#include <map>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class NeighList;

/// Most pairs in the neighbor list of a dense block never touch. This class keeps the pairs that
/// may come near before particles have moved by a small skin against each other, and in each step
/// finds those of them that touch. No pair is missed. It is also the one home of the states of
/// contacts while a list is in use; the store has them from one list to the next.
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
  void keep_states(int state_size, double reach);
  /// From the next list on, the coefficients of each pair are those at its own place.
  void own_coefficients(bool yes) { types_are_places = yes; }
  /// Brings everything to this step. To be called once in each, before forces are evaluated.
  /// \param store  what a new list begins with, null for contacts without a state
  void update(NeighList &, const double *radius, LSMContactStore *store);
  /// Writes the states of all pairs of the list, if they have changed. Returns whether they had.
  bool write_states(LSMContactStore &);
  bool is_empty() const { return build_number < 0; }
  /// Finds again which pairs are across the fault, for groups that change.
  void find_sides();
  /// The place of the pair of two particles, in this order, -1 if it is not kept.
  int place_of(int i, int j);

 private:
  enum class Due { nothing, strays, choice, new_list };    // see due()
  struct Listed {
    int i, jj, j;
    int place;    // -1 if it is not kept
  };
  struct Chosen {
    int n, place_before;
    bool has_state;
  };

  LAMMPS *const lmp_;
  LSMListPatch patch;
  LSMTravel travel;
  const LSMTypePairs<int> *active = nullptr;
  const LSMEnergySource *sides = nullptr;
  bool screened = false, types_are_places = false;
  NeighList *list = nullptr;
  const double *radius = nullptr;

  int size_of_states = 0;
  double state_reach = 0.0;    // in sums of radii
  bool changed = false;        // since the last list or write_states()

  std::vector<Listed> listed;      // the whole neighbor list, and behind it what was added since
  bigint build_number = -1;        // number of the build of the list
  std::vector<double> x_chosen;    // positions when the pairs were chosen, those of strays later
                                   // ones
  std::vector<double> moved;       // bounds of displacements since then, without those of strays
  // The few particles, ghosts among them, that have moved so far since the pairs were chosen that
  // all of their pairs are kept; their motion does not matter then.
  std::vector<int> strays;
  size_t admitted = 0;                    // strays all of whose pairs are kept
  std::vector<int> first_of, pairs_of;    // listed pairs of each particle, once there are strays
  std::vector<Chosen> chosen;             // of no use outside of choose()
  std::map<std::pair<int, int>, int> places;    // see place_of()

  void forget() { build_number = -1; }
  Due due(const double *x);
  void choose(const double *x, bool new_list, LSMContactStore *);
  int status() const;
  bool settle(int place);
  void keep_pairs_of_strays();
  double displacement(const double *x, size_t first, size_t last) const;
  void hold_strays(const double *x);
  bool find_strays(const double *x, size_t first, size_t last);
  void index_listed();
  bool is_left_out(const Listed &) const;
  void keep(int n, const double *state = nullptr);
  int side_of(int i, int j) const;
};

}    // namespace LAMMPS_NS

#endif
