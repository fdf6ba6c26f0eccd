// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_near_pairs.h"

#include "neigh_list.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// A wider skin keeps more pairs (0.19 a particle with 0.05, 0.29 with 0.1), a narrower one has them
// looked for more often (every 230 and 490 steps on the fault of length 120).
static constexpr double SKIN = 0.05;
static constexpr double ROUNDING = 1e-9;    // of the skin, and of squares of distances
static constexpr double FEW =
    0.5;    // up to this number of listed pairs per particle, all of them are kept

// the largest displacement of the particles in [first, last) since the pairs were chosen
double LSMNearPairs::displacement(const double *x, size_t first, size_t last) const
{
  double most = 0.0;    // square
  for (size_t n = 3 * first; n < 3 * last; n += 3) {
    const double dx = x[n] - held[n], dy = x[n + 1] - held[n + 1], dz = x[n + 2] - held[n + 2];
    most = std::max(most, dx * dx + dy * dy + dz * dz);
  }
  return sqrt(most);
}

// Whether a pair that is not kept may have come near. At least one particle of a pair is owned by
// this rank. Positions of owned particles are compared only when the sum of their largest moves is
// too large; those of ghosts, which are few and are moved by other ranks, in each step.
bool LSMNearPairs::outdated(const double *x, int nlocal, double farthest)
{
  const double ghosts = displacement(x, nlocal, held.size() / 3);
  moved += farthest;
  const auto too_far = [&] { return !(moved + std::max(moved, ghosts) < SKIN * (1.0 - ROUNDING)); };
  if (!too_far()) return false;
  moved = displacement(x, 0, nlocal);
  return too_far();
}

bool LSMNearPairs::is_due(bigint build, const NeighList &list, const double *x, int nlocal,
                          int count, double farthest)
{
  if (build == built) return !held.empty() && outdated(x, nlocal, farthest);
  listed.clear();
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; jj++)
      listed.push_back({i, jj, list.firstneigh[i][jj] & NEIGHMASK});
  }
  held.resize(listed.size() > FEW * count ? 3 * static_cast<size_t>(count) : 0);
  built = build;
  return true;
}

// Whether a pair is near is unpredictable for the processor, so the loop has no branches.
void LSMNearPairs::choose(const double *x, const double *radius, double reach,
                          const int *const *touch)
{
  std::copy_n(x, held.size(), held.begin());
  moved = 0.0;
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
    const double r0 = radius[pair.i] + radius[pair.j];
    pairs.push_back({pair.i, pair.jj});
    ends.push_back({3 * pair.i, 3 * pair.j});
    within.push_back(r0 * r0 * (1.0 + ROUNDING));
    limit.push_back(touch && touch[pair.i][pair.jj] ? INFINITY : within.back());
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
