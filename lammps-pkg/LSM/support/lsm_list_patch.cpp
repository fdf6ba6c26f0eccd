// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_list_patch.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "lsm_near_pairs.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace LAMMPS_NS;

// Up to this number of particles at a time. If more have moved far, all lists are built anew.
static constexpr std::size_t MOST = 64;

static double distance_sq(const double *a, const double *b)
{
  double sum = 0.0;
  for (int c = 0; c < 3; c++) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// How far particles may be from where they were when the list was built. A pair of which neither
// particle has the other as a ghost is farther apart than the cutoff of ghosts by then, and later
// by up to two margins less; it may not be nearer than a pair that is not listed. Not positive if
// lists cannot be added to.
double LSMListPatch::find_margin(const NeighList &of) const
{
  bool simple = update->whichflag == 1 && utils::strmatch(update->integrate_style, "^verlet") &&
                !force->newton_pair && !domain->box_change && !domain->triclinic &&
                comm->mode == Comm::SINGLE && comm->style == Comm::BRICK && !neighbor->exclude &&
                !neighbor->includegroup && neighbor->dist_check &&
                atom->molecular != Atom::TEMPLATE;
  for (int n = 0; n < neighbor->nlist; n++) {
    const NeighList *const other = neighbor->lists[n];
    if (other && other != &of && other != of.listskip) simple = false;
  }
  if (!simple || of.copy) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int c = 0; c < domain->dimension; c++) least = std::min(least, comm->cutghost[c]);
  return 0.5 * (least - neighbor->cutneighmax);
}

void LSMListPatch::start(NeighList &of, const LSMTypePairs<int> &active_types)
{
  rows.clear();
  active = &active_types;
  margin = find_margin(of);
  // until they are looked at again, particles go on moving
  const double trigger = 0.5 * neighbor->skin - LSMNearPairs::SKIN;
  list = trigger > 0.0 && margin > 0.5 * neighbor->skin ? &of : nullptr;
  if (!list) return;
  trigger_sq = trigger * trigger;
  const int count = atom->nlocal + atom->nghost;
  built.assign(atom->x[0], atom->x[0] + 3 * static_cast<std::size_t>(count));
  held = built;
  sorted.clear();
}

const std::vector<LSMListPatch::Added> &LSMListPatch::look_at(const std::vector<int> &particles)
{
  far.clear();
  if (list)
    for (const int i : particles)
      if (distance_sq(atom->x[i], &held[3 * static_cast<std::size_t>(i)]) > trigger_sq)
        far.push_back(i);
  return add_pairs_of_far();
}

// Ghosts first: it has to be known whether any has moved far, also if many particles have.
const std::vector<LSMListPatch::Added> &LSMListPatch::look_at_all()
{
  far.clear();
  if (list)
    for (int i = static_cast<int>(held.size() / 3) - 1; i >= 0 && far.size() <= MOST; i--)
      if (distance_sq(atom->x[i], &held[3 * static_cast<std::size_t>(i)]) > trigger_sq)
        far.push_back(i);
  return add_pairs_of_far();
}

// A rank with a particle that has gone too far notes no new position, so that LAMMPS builds all
// lists. For ghosts it has to be asked to, as their own rank may have noted one.
const std::vector<LSMListPatch::Added> &LSMListPatch::add_pairs_of_far()
{
  added.clear();
  const bool many = far.size() > MOST;
  for (const int i : far) {
    const std::size_t place = 3 * static_cast<std::size_t>(i);
    const bool ghost = i >= atom->nlocal;
    const double most = margin * (ghost ? 1.0 + 1e-9 : 1.0);    // ghosts are rounded otherwise
    if (!many && distance_sq(atom->x[i], &built[place]) < most * most) {
      std::copy_n(atom->x[i], 3, &held[place]);
      if (!ghost) std::copy_n(atom->x[i], 3, neighbor->get_xhold()[i]);
      add_pairs_of(i);
    } else if (ghost)
      ask_for_build();
  }
  return added;
}

// LAMMPS finds a particle that has moved infinitely far.
void LSMListPatch::ask_for_build()
{
  if (atom->nlocal > 0) neighbor->get_xhold()[0][0] = std::numeric_limits<double>::infinity();
}

void LSMListPatch::sort_into_cells()
{
  const int count = static_cast<int>(built.size() / 3);
  cell = neighbor->cutneighmax + 2.0 * margin;    // particles have moved by up to a margin
  for (int c = 0; c < 2; c++) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (int i = 0; i < count; i++) {
      lowest = std::min(lowest, built[3 * static_cast<std::size_t>(i) + c]);
      highest = std::max(highest, built[3 * static_cast<std::size_t>(i) + c]);
    }
    corner[c] = lowest - cell;    // with a row of empty cells on each side
    cells[c] = static_cast<int>((highest - lowest) / cell) + 3;
  }
  std::vector<int> cell_of(count);
  first_in.assign(static_cast<std::size_t>(cells[0]) * cells[1] + 1, 0);
  for (int i = 0; i < count; i++) {
    cell_of[i] = find_cell(&built[3 * static_cast<std::size_t>(i)]);
    first_in[cell_of[i] + 1]++;
  }
  std::partial_sum(first_in.begin(), first_in.end(), first_in.begin());
  std::vector<int> next(first_in.begin(), first_in.end() - 1);
  sorted.resize(count);
  for (int i = 0; i < count; i++) sorted[next[cell_of[i]]++] = i;
}

int LSMListPatch::find_cell(const double *position) const
{
  int at[2];
  for (int c = 0; c < 2; c++) at[c] = static_cast<int>((position[c] - corner[c]) / cell);
  return at[1] * cells[0] + at[0];
}

// Cells are so large that the neighbors of a particle were, when the list was built, in the cell in
// which it was or in one beside it.
void LSMListPatch::add_pairs_of(int i)
{
  if (sorted.empty()) sort_into_cells();
  const double *const radius = atom->radius;
  const int middle = find_cell(&built[3 * static_cast<std::size_t>(i)]);
  for (int row = -1; row <= 1; row++) {
    const int *const first = &first_in[middle + row * cells[0] - 1];
    for (int n = first[0]; n < first[3]; n++) {
      const int j = sorted[n];
      if (j == i || (i >= atom->nlocal && j >= atom->nlocal)) continue;
      const double cut = radius[i] + radius[j] + neighbor->skin;
      if (distance_sq(&held[3 * static_cast<std::size_t>(i)],
                      &held[3 * static_cast<std::size_t>(j)]) <= cut * cut)
        add_pair(std::min(i, j), std::max(i, j));
    }
  }
}

// The pair is in the neighbors of the particle with the lower index, as in LAMMPS' own list.
void LSMListPatch::add_pair(int i, int j)
{
  if (!(*active)[atom->type[i]][atom->type[j]] || is_linked(i, j) || is_listed(i, j) ||
      (j < atom->nlocal && is_listed(j, i)))
    return;
  std::vector<int> &row = rows[i];
  int *&first = list->firstneigh[i];
  int &count = list->numneigh[i];
  if (row.empty()) row.assign(first, first + count);
  row.push_back(j);
  first = row.data();
  added.push_back({i, count++, j});
}

bool LSMListPatch::is_linked(int i, int j) const
{
  if (atom->molecular == Atom::ATOMIC) return false;
  const tagint *const partners = atom->special[i], *const end = partners + atom->nspecial[i][0];
  if (std::find(partners, end, atom->tag[j]) == end) return false;
  const double *const a = atom->x[i], *const b = atom->x[j];
  return !domain->minimum_image_check(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool LSMListPatch::is_listed(int i, int j) const
{
  const int *const first = list->firstneigh[i], *const end = first + list->numneigh[i];
  return std::any_of(first, end, [j](int entry) { return (entry & NEIGHMASK) == j; });
}
