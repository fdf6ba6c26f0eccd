// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_near_pairs.h"

#include "lsm_mover.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;

// A wider SKIN keeps more pairs (0.19 a particle with 0.05, 0.29 with 0.1), a narrower one has them
// looked for more often (every 230 and 490 steps on the fault of length 120).
static constexpr double ROUNDING = 1e-9;    // of the skin, and of squares of distances
static constexpr double FEW =
    0.5;    // up to this number of listed pairs per particle, all of them are kept
// Displacement of a particle that may be a stray, and how many of them there may be.
static constexpr double STRAY = LSMNearPairs::SKIN / 3.0;
static constexpr int MIN_STRAYS = 8, PARTICLES_PER_STRAY = 128;

// the largest distance of the particles in [first, last) from the positions that are held
double LSMNearPairs::displacement(const double *x, size_t first, size_t last) const
{
  double most = 0.0;    // square
  for (size_t n = 3 * first; n < 3 * last; n += 3) {
    const double dx = x[n] - held[n], dy = x[n + 1] - held[n + 1], dz = x[n + 2] - held[n + 2];
    most = std::max(most, dx * dx + dy * dy + dz * dz);
  }
  return sqrt(most);
}

void LSMNearPairs::hold_strays(const double *x)
{
  for (const size_t i : found_strays) std::copy_n(x + 3 * i, 3, &held[3 * i]);
}

// Adds the particles in [first, last) that have moved far to the strays, unless they are many.
bool LSMNearPairs::find_strays(const double *x, size_t first, size_t last)
{
  const size_t most = MIN_STRAYS + held.size() / 3 / PARTICLES_PER_STRAY;
  for (size_t i = first; i < last; i++)
    if (displacement(x, i, i + 1) > STRAY) {
      if (found_strays.size() == most) return false;
      found_strays.push_back(static_cast<int>(i));
    }
  hold_strays(x);
  return true;
}

// A pair that is not kept may have come near if the particles have moved by the skin against each
// other. At least one particle of a pair is owned by this rank. Positions of the owned particles of
// a block are compared only when the sum of their largest moves is too large; those of ghosts,
// which are few and are moved by other ranks, in each step.
LSMNearPairs::Due LSMNearPairs::due(bigint build, const NeighList &list, const double *x,
                                    int nlocal, int count, const std::vector<double> &moves)
{
  if (build != built) {
    listed.clear();
    for (int ii = 0; ii < list.inum; ii++) {
      const int i = list.ilist[ii];
      for (int jj = 0; jj < list.numneigh[i]; jj++)
        listed.push_back({i, jj, list.firstneigh[i][jj] & NEIGHMASK});
    }
    moved.resize(moves.size());
    held.resize(listed.size() > FEW * nlocal ? 3 * static_cast<size_t>(count) : 0);
    first_of.clear();
    built = build;
    return Due::new_list;
  }
  if (held.empty()) return Due::nothing;
  hold_strays(x);
  double ghosts = displacement(x, nlocal, count);
  const auto too_far = [&ghosts](double move) {
    return !(move + std::max(move, ghosts) < SKIN * (1.0 - ROUNDING));
  };
  const size_t strays_before = found_strays.size();
  if (ghosts > 0.5 * SKIN) {
    if (!find_strays(x, nlocal, count)) return Due::choice;
    ghosts = displacement(x, nlocal, count);
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
  return found_strays.size() > strays_before ? Due::strays : Due::nothing;
}

void LSMNearPairs::index_listed()
{
  first_of.assign(held.size() / 3 + 1, 0);
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

void LSMNearPairs::keep(int n, const double *radius, bool touching)
{
  const Listed &pair = listed[n];
  const double r0 = radius[pair.i] + radius[pair.j];
  is_kept[n] = 1;
  pairs.push_back({pair.i, pair.jj});
  ends.push_back({3 * pair.i, 3 * pair.j});
  within.push_back(r0 * r0 * (1.0 + ROUNDING));
  limit.push_back(touching ? INFINITY : within.back());
}

void LSMNearPairs::keep_pairs_of_strays(const double *radius)
{
  if (first_of.empty()) index_listed();
  for (; admitted < found_strays.size(); admitted++) {
    const int i = found_strays[admitted];
    for (int n = first_of[i]; n < first_of[i + 1]; n++)
      if (!is_kept[pairs_of[n]]) keep(pairs_of[n], radius, false);
    for (size_t n = pairs_of.size() / 2; n < listed.size(); n++)    // added since
      if (!is_kept[n] && (listed[n].i == i || listed[n].j == i))
        keep(static_cast<int>(n), radius, false);
  }
  for (auto &of_a_step : vectors) of_a_step.resize(2 * pairs.size());
}

void LSMNearPairs::add(int i, int jj, int j, const double *radius)
{
  listed.push_back({i, jj, j});
  is_kept.push_back(0);
  keep(static_cast<int>(listed.size()) - 1, radius, false);
  for (auto &of_a_step : vectors) of_a_step.resize(2 * pairs.size());
  found.resize(listed.size());
}

// Whether a pair is near is unpredictable for the processor, so the loop has no branches.
void LSMNearPairs::choose(const double *x, const double *radius, double reach,
                          const int *const *touch)
{
  std::copy_n(x, held.size(), held.begin());
  std::fill(moved.begin(), moved.end(), 0.0);
  found_strays.clear();
  admitted = 0;
  is_kept.assign(listed.size(), 0);
  found.resize(listed.size());
  const bool all = held.empty();
  int count = 0;
  for (int n = 0; n < static_cast<int>(listed.size()); n++) {
    const Listed &pair = listed[n];
    const double *const a = x + 3 * static_cast<size_t>(pair.i);
    const double *const b = x + 3 * static_cast<size_t>(pair.j);
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    const double far = reach * (radius[pair.i] + radius[pair.j]) + SKIN;
    const bool touching = touch && touch[pair.i][pair.jj];
    found[count] = n;    // overwritten by the next one unless count advances
    count += all | touching | !(dx * dx + dy * dy + dz * dz > far * far);
  }

  pairs.clear();
  ends.clear();
  within.clear();
  limit.clear();
  for (int m = 0; m < count; m++) {
    const Listed &pair = listed[found[m]];
    keep(found[m], radius, touch && touch[pair.i][pair.jj]);
  }
  for (auto &of_a_step : vectors) of_a_step.resize(2 * pairs.size());
}

// Distances along x and y suffice to leave out nearly all other pairs, in three dimensions, too.
void LSMNearPairs::find(const double *x)
{
  newest = 1 - newest;
  const Ends *const end = ends.data();
  const double *const most = limit.data();
  double *const vector = vectors[newest].data();
  int *const to = found.data();
  const int n = static_cast<int>(pairs.size());
  int count = 0;
  for (int m = 0; m < n; m++) {
    const double *const a = x + end[m].i, *const b = x + end[m].j;
    const double dx = a[0] - b[0], dy = a[1] - b[1];
    vector[2 * m] = dx;
    vector[2 * m + 1] = dy;
    to[count] = m;    // overwritten by the next one unless count advances
    count += !(dx * dx + dy * dy > most[m]);
  }
  number = count;
}
