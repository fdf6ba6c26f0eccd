// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_near_pairs.h"

#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

// A wider skin keeps more pairs (0.19 a particle with 0.05, 0.29 with 0.1), a narrower one has them looked for more
// often (every 230 and 490 steps on the fault of length 120).
static constexpr double SKIN = 0.05;
static constexpr double ROUNDING = 1e-9;    // of the skin, and of squares of distances
static constexpr double FEW =
    0.5;    // pairs for each particle that are looked at rather than sorted out

using Two = double __attribute__((vector_size(2 * sizeof(double))));

static inline Two load(const double *from)
{
  Two v;
  memcpy(&v, from, sizeof(v));
  return v;
}

static inline void store(double *to, const Two &v)
{
  memcpy(to, &v, sizeof(v));
}

// range of the displacements of the particles from first to before last
LSMNearPairs::Range LSMNearPairs::displacements(const double *x, size_t first, size_t last) const
{
  // two numbers of two particles at a time: 12 of four particles stay in registers
  constexpr int LANES = 12;
  Two least[LANES / 2], most[LANES / 2];
  for (int m = 0; m < LANES / 2; m++) {
    least[m] = Two{INFINITY, INFINITY};
    most[m] = -least[m];
  }
  const double *const from = held.data();
  size_t n = 3 * first;
  for (; n + LANES <= 3 * last; n += LANES)
#pragma GCC unroll 6
    for (int m = 0; m < LANES / 2; m++) {
      const Two change = load(x + n + 2 * m) - load(from + n + 2 * m);
      least[m] = change < least[m] ? change : least[m];
      most[m] = change > most[m] ? change : most[m];
    }
  double low[LANES], high[LANES];
  memcpy(low, least, sizeof(low));
  memcpy(high, most, sizeof(high));
  for (int lane = 0; n + lane < 3 * last; lane++) {
    low[lane] = std::min(low[lane], x[n + lane] - from[n + lane]);
    high[lane] = std::max(high[lane], x[n + lane] - from[n + lane]);
  }

  Range range;
  for (int c = 0; c < 3; c++) {
    range.low[c] = low[c];
    range.high[c] = high[c];
    for (int lane = c + 3; lane < LANES; lane += 3) {
      range.low[c] = std::min(range.low[c], low[lane]);
      range.high[c] = std::max(range.high[c], high[lane]);
    }
  }
  return range;
}

// No two particles have moved against each other by more than the range of all displacements. Those of this rank's
// particles are looked at only when the sum of their longest moves would be too much; ghosts are few, and others
// move them.
bool LSMNearPairs::outdated(const double *x, int nlocal, double farthest)
{
  const Range ghosts = displacements(x, nlocal, held.size() / 3);
  travelled += farthest;
  const auto too_far = [&] {
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
      const double low = std::min(moved.low[c] - travelled, ghosts.low[c]);
      const double high = std::max(moved.high[c] + travelled, ghosts.high[c]);
      square += (high - low) * (high - low);
    }
    constexpr double skin = SKIN * (1.0 - ROUNDING);
    return !(square < skin * skin);
  };
  if (!too_far()) return false;
  moved = displacements(x, 0, nlocal);
  travelled = 0.0;
  return too_far();
}

bool LSMNearPairs::is_due(bigint build, const NeighList &list, const double *x, int nlocal,
                          int count, double farthest)
{
  if (build == built) return !held.empty() && outdated(x, nlocal, farthest);
  bigint all = 0;
  for (int ii = 0; ii < list.inum; ii++) all += list.numneigh[list.ilist[ii]];
  held.resize(all > FEW * count ? 3 * static_cast<size_t>(count) : 0);
  built = build;
  return true;
}

void LSMNearPairs::choose(const NeighList &list, const double *x, const double *radius,
                          double reach, const int *const *touch)
{
  std::copy_n(x, held.size(), held.begin());
  moved = Range{};
  travelled = 0.0;
  pairs.clear();
  ends.clear();
  within.clear();
  limit.clear();
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    const double *const xi = x + 3 * static_cast<size_t>(i);
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const double *const xj = x + 3 * static_cast<size_t>(j);
      const double dx = xi[0] - xj[0], dy = xi[1] - xj[1], dz = xi[2] - xj[2];
      const double r0 = radius[i] + radius[j], far = reach * r0 + SKIN;
      const bool touching = touch && touch[i][jj];
      if (!held.empty() && dx * dx + dy * dy + dz * dz > far * far && !touching) continue;
      pairs.push_back({i, jj});
      ends.push_back({3 * i, 3 * j});
      within.push_back(r0 * r0 * (1.0 + ROUNDING));
      limit.push_back(touching ? INFINITY : within.back());
    }
  }
  found.resize(pairs.size() + 1);
  for (auto &of_a_step : vectors) of_a_step.resize(2 * pairs.size());
}

// Distances along x and y are enough to leave out nearly all others in three dimensions, too.
void LSMNearPairs::find(const double *x)
{
  const int n = static_cast<int>(pairs.size());
  newest = 1 - newest;
  double *const vector = vectors[newest].data();
  int *const to = found.data();
  int count = 0, m = 0;
  for (; m + 2 <= n; m += 2) {
    Two a = load(x + ends[m].i) - load(x + ends[m].j);
    Two b = load(x + ends[m + 1].i) - load(x + ends[m + 1].j);
    store(vector + 2 * m, a);
    store(vector + 2 * m + 2, b);
    a *= a;
    b *= b;
    const auto far = Two{a[0], b[0]} + Two{a[1], b[1]} > load(&limit[m]);
    to[count] = m;
    count += !far[0];
    to[count] = m + 1;
    count += !far[1];
  }
  if (m < n) {
    const Two a = load(x + ends[m].i) - load(x + ends[m].j);
    store(vector + 2 * m, a);
    to[count] = m;
    count += !(a[0] * a[0] + a[1] * a[1] > limit[m]);
  }
  number = count;
}
