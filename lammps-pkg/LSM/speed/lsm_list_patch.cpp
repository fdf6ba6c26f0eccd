// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_list_patch.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "lsm_near_pairs.h"
#include "lsm_scene.h"
#include "math_extra.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <limits>
#include <numeric>

using namespace LAMMPS_NS;
using MathExtra::distsq3;

// The largest number of particles whose pairs are added at a time.
static constexpr std::size_t MOST = 64;

// How far particles may be from where they were when the list was built; not positive if pairs
// cannot be added to the list.
//
// Two particles of different ranks, of which one does not have the other as a ghost, were farther
// apart than the cutoff of ghosts when the list was built. Each may then move by the margin and by
// half the skin, so that such pairs stay farther apart than the sum of their radii. When particles
// change ranks, they must have moved by less than the width of a sub-domain.
double LSMListPatch::find_margin(const NeighList &of) const
{
  bool simple = update->whichflag == 1 && utils::strmatch(update->integrate_style, "^verlet") &&
      !force->newton_pair && !domain->box_change && !domain->triclinic &&
      comm->mode == Comm::SINGLE && comm->style == Comm::BRICK && !neighbor->exclude &&
      !neighbor->includegroup && neighbor->dist_check && !of.copy &&
      atom->molecular != Atom::TEMPLATE;
  for (int n = 0; n < neighbor->nlist; n++) {
    const NeighList *const other = neighbor->lists[n];
    simple = simple &&
        (!other || other == &of ||
         (other == of.listskip && other->requestor_type == NeighList::NONE));
  }
  if (!simple || LSMScene::may_rely_on_skin(modify)) return 0.0;

  double margin_of_all = std::numeric_limits<double>::infinity();
  const double *const splits[] = {comm->xsplit, comm->ysplit, comm->zsplit};
  for (int c = 0; c < domain->dimension; c++) {
    margin_of_all = std::min(margin_of_all, 0.5 * (comm->cutghost[c] - neighbor->cutneighmax));
    for (int n = 0; n < comm->procgrid[c]; n++)
      margin_of_all = std::min(margin_of_all,
                               (splits[c][n + 1] - splits[c][n]) * domain->prd[c] - neighbor->skin);
  }
  return margin_of_all;
}

// Where forces are found again without a build (as by the package MDI), the list is the old one, and
// rows that were added are in use. Other ranks may have refreshed positions of particles that this
// one knows as ghosts, so all lists are built.
void LSMListPatch::start(NeighList &of, const LSMTypePairs<int> &active_types)
{
  list = nullptr;
  if (neighbor->ago != 0) {
    if (may_be_refreshed) ask_for_build();
    return;
  }
  may_be_refreshed = false;
  rows.clear();
  sorted.clear();
  wants_build = false;
  active = &active_types;
  margin = find_margin(of);
  // particles that are no strays may move by SKIN until they are looked at
  const double trigger = 0.5 * neighbor->skin - LSMNearPairs::SKIN;
  if (!(trigger > 0.0 && margin > 0.5 * neighbor->skin)) return;
  list = &of;
  may_be_refreshed = true;
  trigger_sq = trigger * trigger;
  const int count = atom->nlocal + atom->nghost;
  x_build.assign(atom->x[0], atom->x[0] + 3 * static_cast<std::size_t>(count));
  x_listed = x_build;
}

bool LSMListPatch::is_far(int i) const
{
  return distsq3(atom->x[i], &x_listed[3 * static_cast<std::size_t>(i)]) > trigger_sq;
}

const std::vector<LSMListPatch::Added> &LSMListPatch::look_at(const std::vector<int> &particles)
{
  far.clear();
  if (list)
    for (const int i : particles)
      if (is_far(i)) far.push_back(i);
  return add_pairs_of_far();
}

// Ghosts first: it has to be known whether any has moved far, also if many particles have.
const std::vector<LSMListPatch::Added> &LSMListPatch::look_at_all(int first)
{
  far.clear();
  if (list)
    for (int i = static_cast<int>(x_listed.size() / 3) - 1; i >= first && far.size() <= MOST; i--)
      if (is_far(i)) far.push_back(i);
  return add_pairs_of_far();
}

// The position of a particle that has gone too far is not refreshed, so that LAMMPS' check finds it
// and all lists are built. For a ghost it may have been refreshed on the rank that owns it; then
// this rank makes the check find a particle that has moved infinitely far.
const std::vector<LSMListPatch::Added> &LSMListPatch::add_pairs_of_far()
{
  added.clear();
  const bool many = far.size() > MOST;
  for (const int i : far) {
    const std::size_t place = 3 * static_cast<std::size_t>(i);
    const bool ghost = i >= atom->nlocal;
    const double most = margin * (ghost ? 1.0 + 1e-9 : 1.0);    // ghosts are rounded otherwise
    if (!many && distsq3(atom->x[i], &x_build[place]) < most * most) {
      std::copy_n(atom->x[i], 3, &x_listed[place]);
      if (!ghost) std::copy_n(atom->x[i], 3, neighbor->get_xhold()[i]);
      add_pairs_of(i);
    } else
      wants_build = wants_build || ghost;
  }
  if (list && wants_build) ask_for_build();
  return added;
}

void LSMListPatch::ask_for_build()
{
  if (atom->nlocal > 0) neighbor->get_xhold()[0][0] = std::numeric_limits<double>::infinity();
}

void LSMListPatch::sort_into_cells()
{
  const int count = static_cast<int>(x_build.size() / 3);
  // particles have moved by up to a margin, or a little more because of rounding
  cell = (neighbor->cutneighmax + 2.0 * margin) * (1.0 + 1e-6);
  for (int c = 0; c < 2; c++) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (int i = 0; i < count; i++) {
      lowest = std::min(lowest, x_build[3 * static_cast<std::size_t>(i) + c]);
      highest = std::max(highest, x_build[3 * static_cast<std::size_t>(i) + c]);
    }
    // with a row of empty cells on each side, however positions are rounded
    corner[c] = lowest - 1.5 * cell;
    cells[c] = static_cast<int>((highest - lowest) / cell + 1.5) + 2;
  }
  std::vector<int> cell_of(count);
  first_in.assign(static_cast<std::size_t>(cells[0]) * cells[1] + 1, 0);
  for (int i = 0; i < count; i++) {
    cell_of[i] = find_cell(&x_build[3 * static_cast<std::size_t>(i)]);
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
  const int middle = find_cell(&x_build[3 * static_cast<std::size_t>(i)]);
  for (int row = -1; row <= 1; row++) {
    const int *const first = &first_in[middle + row * cells[0] - 1];
    for (int n = first[0]; n < first[3]; n++) {
      const int j = sorted[n];
      if (j == i || (i >= atom->nlocal && j >= atom->nlocal)) continue;
      const double cut = radius[i] + radius[j] + neighbor->skin;
      if (distsq3(&x_listed[3 * static_cast<std::size_t>(i)],
                  &x_listed[3 * static_cast<std::size_t>(j)]) <= cut * cut)
        add_pair(std::min(i, j), std::max(i, j));
    }
  }
}

// The pair is in the neighbors of the particle with the lower index, as in LAMMPS' own list.
void LSMListPatch::add_pair(int i, int j)
{
  if (!(*active)[atom->type[i]][atom->type[j]] || is_excluded(i, j) || is_listed(i, j) ||
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

// LAMMPS' own rule: pairs linked directly, or over one or two other particles, may be left out.
bool LSMListPatch::is_excluded(int i, int j) const
{
  if (atom->molecular == Atom::ATOMIC) return false;
  const tagint *const partners = atom->special[i];
  const int *const ends = atom->nspecial[i];
  const auto n = std::find(partners, partners + ends[2], atom->tag[j]) - partners;
  if (n == ends[2] || neighbor->special_flag[n < ends[0] ? 1 : n < ends[1] ? 2 : 3] != 0)
    return false;
  const double *const a = atom->x[i], *const b = atom->x[j];
  return !domain->minimum_image_check(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool LSMListPatch::is_listed(int i, int j) const
{
  const int *const first = list->firstneigh[i], *const end = first + list->numneigh[i];
  return std::any_of(first, end, [j](int entry) {
    return (entry & NEIGHMASK) == j;
  });
}
