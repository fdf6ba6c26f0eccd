// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_near_pairs.h"

#include "atom.h"
#include "domain.h"
#include "force.h"
#include "friction/force_laws.h"
#include "friction/friction_contact.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;
using namespace LSM::friction_contact;

// A wider SKIN keeps more pairs (0.19 a particle with 0.05, 0.29 with 0.1), a narrower one has them
// looked for more often (every 230 and 490 steps on the fault of length 120).

// Displacement of a particle that may be a stray, and how many of them there may be.
static constexpr double STRAY = LSMNearPairs::SKIN / 3.0;
static constexpr int MIN_STRAYS = 8, PARTICLES_PER_STRAY = 128;

void LSMNearPairs::init(const LSMTypePairs<int> &active_types, bool screens,
                        const LSMEnergySource &source)
{
  forget();    // the list may have changed, and its builds are counted anew
  patch.stop();
  active = &active_types;
  screened = screens;
  sides = &source;
  changed = false;    // the states were written at the end of the previous run
}

void LSMNearPairs::keep_states(int size, double reach)
{
  size_of_states = size;
  state_reach = reach;
}

void LSMNearPairs::update(NeighList &of, const double *radii, LSMContactStore *store)
{
  list = &of;
  radius = radii;
  if (lmp_->update->setupflag) forget();    // the number of a build may have been used before
  const double *const x = lmp_->atom->x[0];
  const Due what = due(x);

  if (what == Due::new_list) {
    screened ? patch.stop() : patch.start(of, *active);
  } else {
    const auto &added = what == Due::choice ? patch.look_at_all(0) : patch.look_at(strays);
    for (const LSMListPatch::Added &pair : added) {
      if (store) store->add_pair(pair.i, pair.jj);
      listed.push_back({pair.i, pair.jj, pair.j, -1});
      keep(static_cast<int>(listed.size()) - 1);
    }
  }
  if (what == Due::new_list || what == Due::choice)
    choose(x, what == Due::new_list, store);
  else if (what == Due::strays)
    keep_pairs_of_strays();
  find(x);
  changed = true;
}

// the largest distance of the particles in [first, last) from the positions x_chosen
double LSMNearPairs::displacement(const double *x, size_t first, size_t last) const
{
  double most = 0.0;    // square
  for (size_t n = 3 * first; n < 3 * last; n += 3) {
    const double dx = x[n] - x_chosen[n], dy = x[n + 1] - x_chosen[n + 1],
                 dz = x[n + 2] - x_chosen[n + 2];
    most = std::max(most, dx * dx + dy * dy + dz * dz);
  }
  return sqrt(most);
}

void LSMNearPairs::hold_strays(const double *x)
{
  for (const size_t i : strays) std::copy_n(x + 3 * i, 3, &x_chosen[3 * i]);
}

// Adds the particles in [first, last) that have moved far to the strays, unless they are many.
bool LSMNearPairs::find_strays(const double *x, size_t first, size_t last)
{
  const size_t most = MIN_STRAYS + x_chosen.size() / 3 / PARTICLES_PER_STRAY;
  for (size_t i = first; i < last; i++)
    if (displacement(x, i, i + 1) > STRAY) {
      if (strays.size() == most) return false;
      strays.push_back(static_cast<int>(i));
    }
  hold_strays(x);
  return true;
}

// A pair that is not kept may have come near if the particles have moved by the skin against each
// other. At least one particle of a pair is owned by this rank. Positions of the owned particles of
// a block are compared only when the sum of their largest moves is too large; those of ghosts,
// which are few and are moved by other ranks, in each step.
LSMNearPairs::Due LSMNearPairs::due(const double *x)
{
  const std::vector<double> &moves = travel.since_last();
  const int nlocal = lmp_->atom->nlocal, all = nlocal + lmp_->atom->nghost;
  if (lmp_->neighbor->ncalls != build_number) {
    build_number = lmp_->neighbor->ncalls;
    listed.clear();
    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      for (int jj = 0; jj < list->numneigh[i]; jj++)
        listed.push_back({i, jj, list->firstneigh[i][jj] & NEIGHMASK, -1});
    }
    moved.resize(moves.size());
    x_chosen.resize(3 * static_cast<size_t>(all));
    first_of.clear();
    return Due::new_list;
  }
  hold_strays(x);
  double ghosts = displacement(x, nlocal, all);
  const auto too_far = [&ghosts](double move) {
    return !(move + std::max(move, ghosts) < SKIN * (1.0 - ROUNDING));
  };
  const size_t strays_before = strays.size();
  if (ghosts > 0.5 * SKIN) {
    if (!find_strays(x, nlocal, all)) return Due::choice;
    ghosts = displacement(x, nlocal, all);
  }
  for (size_t b = 0; b < moved.size(); b++) {
    moved[b] += moves[b];
    if (!too_far(moved[b])) continue;
    const size_t first = b * LSMMover::BLOCK,
                 last = std::min(first + LSMMover::BLOCK, static_cast<size_t>(nlocal));
    moved[b] = displacement(x, first, last);
    if (!too_far(moved[b])) continue;
    if (!find_strays(x, first, last)) return Due::choice;
    moved[b] = displacement(x, first, last);
  }
  return strays.size() > strays_before ? Due::strays : Due::nothing;
}

void LSMNearPairs::index_listed()
{
  first_of.assign(x_chosen.size() / 3 + 1, 0);
  for (const Listed &pair : listed) {
    first_of[pair.i + 1]++;
    first_of[pair.j + 1]++;
  }
  std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());
  pairs_of.resize(2 * listed.size());
  std::vector<int> next = first_of;
  for (int n = 0; n < static_cast<int>(listed.size()); n++) {
    pairs_of[next[listed[n].i]++] = n;
    pairs_of[next[listed[n].j]++] = n;
  }
}

// A pair with a state that does not touch is found by its distance.
void LSMNearPairs::keep(int n, const double *state_before)
{
  Listed &pair = listed[n];
  if (screened && is_left_out(pair)) return;
  const int i = pair.i, j = pair.j, *const type = lmp_->atom->type;
  pair.place = count();
  const int coefficients = types_are_places ? count() : active->place(type[i], type[j]);
  LSMContacts::add({i, j, coefficients, side_of(i, j), radius[i] + radius[j],
                    LSM::contact_size(radius[i], radius[j])},
                   state_before && state_before[status()] != NEAR);
  if (state_before) std::copy_n(state_before, state_size, state(pair.place));
}

int LSMNearPairs::side_of(int i, int j) const
{
  return sides->across_fault(lmp_->atom->mask[i], lmp_->atom->mask[j]);
}

void LSMNearPairs::find_sides()
{
  for (Pair &pair : pairs) pair.across = side_of(pair.i, pair.j);
}

void LSMNearPairs::keep_pairs_of_strays()
{
  if (first_of.empty()) index_listed();
  for (; admitted < strays.size(); admitted++) {
    const int i = strays[admitted];
    for (int n = first_of[i]; n < first_of[i + 1]; n++)
      if (listed[pairs_of[n]].place < 0) keep(pairs_of[n]);
    for (size_t n = pairs_of.size() / 2; n < listed.size(); n++)    // added since
      if (listed[n].place < 0 && (listed[n].i == i || listed[n].j == i)) keep(static_cast<int>(n));
  }
}

// Whether a pair is near is unpredictable for the processor, so the loop has no branches. States
// are taken from the store for a new list, and from the pairs kept so far otherwise.
void LSMNearPairs::choose(const double *x, bool new_list, LSMContactStore *store)
{
  std::copy_n(x, x_chosen.size(), x_chosen.begin());
  std::fill(moved.begin(), moved.end(), 0.0);
  strays.clear();
  admitted = 0;
  chosen.resize(listed.size());
  const double reach = std::max(state_reach, 1.0);
  int most = 0;
  for (int n = 0; n < static_cast<int>(listed.size()); n++) {
    Listed &pair = listed[n];
    const double *const a = x + 3 * static_cast<size_t>(pair.i);
    const double *const b = x + 3 * static_cast<size_t>(pair.j);
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    const double far = reach * (radius[pair.i] + radius[pair.j]) + SKIN;
    const bool has_state = new_list ? store && *store->touch_of(pair.i, pair.jj)
                                    : pair.place >= 0 && settle(pair.place);
    // overwritten by the next one unless the number advances
    chosen[most] = {n, std::exchange(pair.place, -1), has_state};
    most += has_state | !(dx * dx + dy * dy + dz * dz > far * far);
  }

  std::vector<double> before;
  before.swap(states);
  begin(size_of_states, lmp_->domain->dimension);
  places.clear();
  for (int m = 0; m < most; m++) {
    const auto &[n, place, has_state] = chosen[m];
    keep(n,
         !has_state     ? nullptr
             : new_list ? store->values_of(listed[n].i, listed[n].jj)
                        : &before[static_cast<size_t>(place) * state_size]);
  }
}

int LSMNearPairs::status() const
{
  return dim == 3 ? Kept<3>::STATUS : Kept<2>::STATUS;
}

// Completes the state of a pair that does not touch: whether it is near follows from its vector
// alone, which a pair has that was there in the step before. Returns whether there is a state.
bool LSMNearPairs::settle(int place)
{
  if (state_size == 0 || place >= at_last_find) return false;
  if (is_touching(place)) return true;
  const double *const d = vector(place), far = state_reach * pairs[place].r0;
  const double square = dim == 3 ? square_of<3>(d) : square_of<2>(d);
  bool is_near = square <= far * far;
  double *const h = state(place);
  dim == 3 ? keep_near<3>(is_near, d, is_near, h) : keep_near<2>(is_near, d, is_near, h);
  return is_near;
}

bool LSMNearPairs::write_states(LSMContactStore &store)
{
  if (!changed || build_number != lmp_->neighbor->ncalls) return false;
  changed = false;
  for (const Listed &pair : listed) {
    const bool has_state = pair.place >= 0 && settle(pair.place);
    *store.touch_of(pair.i, pair.jj) = has_state;
    if (has_state) std::copy_n(state(pair.place), state_size, store.values_of(pair.i, pair.jj));
  }
  return true;
}

int LSMNearPairs::place_of(int i, int j)
{
  while (static_cast<int>(places.size()) < count()) {
    const int place = static_cast<int>(places.size());
    places[{pairs[place].i, pairs[place].j}] = place;
  }
  const auto found = places.find({i, j});
  return found == places.end() ? -1 : found->second;
}

bool LSMNearPairs::is_left_out(const Listed &pair) const
{
  const int *const type = lmp_->atom->type;
  const int entry = list->firstneigh[pair.i][pair.jj];
  return !(*active)[type[pair.i]][type[pair.j]] ||
      lmp_->force->special_lj[entry >> SBBITS & 3] == 0.0;
}
