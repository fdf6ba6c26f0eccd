/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_near_pairs.h"

#include "neigh_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

// A wider skin keeps more pairs (0.19 a particle with 0.05, 0.29 with 0.1), a narrower one has them looked for more
// often (every 230 and 490 steps on the fault of length 120).
static constexpr double SKIN = 0.05;
static constexpr double ROUNDING = 1e-9;    // of the skin
static constexpr double FEW =
    0.5;    // pairs for each particle that are looked at rather than sorted out

/* ----------------------------------------------------------------------
   No two particles have moved against each other by more than the range of all displacements.
------------------------------------------------------------------------- */

bool LSMNearPairs::outdated(const double *x) const
{
  // two numbers of two particles at a time: 12 of four particles stay in registers
  using Pair = double __attribute__((vector_size(2 * sizeof(double))));
  constexpr int LANES = 12;
  Pair least[LANES / 2], most[LANES / 2];
  for (int m = 0; m < LANES / 2; m++) {
    least[m] = Pair{INFINITY, INFINITY};
    most[m] = -least[m];
  }
  const double *const from = held.data();
  size_t n = 0;
  for (; n + LANES <= held.size(); n += LANES)
#pragma GCC unroll 6
    for (int m = 0; m < LANES / 2; m++) {
      Pair now, then;
      memcpy(&now, x + n + 2 * m, sizeof(now));
      memcpy(&then, from + n + 2 * m, sizeof(then));
      const Pair moved = now - then;
      least[m] = moved < least[m] ? moved : least[m];
      most[m] = moved > most[m] ? moved : most[m];
    }
  double low[LANES], high[LANES];
  memcpy(low, least, sizeof(low));
  memcpy(high, most, sizeof(high));
  for (int lane = 0; n + lane < held.size(); lane++) {
    low[lane] = std::min(low[lane], x[n + lane] - from[n + lane]);
    high[lane] = std::max(high[lane], x[n + lane] - from[n + lane]);
  }

  double square = 0.0;
  for (int c = 0; c < 3; c++) {
    double lowest = low[c], highest = high[c];
    for (int lane = c + 3; lane < LANES; lane += 3) {
      lowest = std::min(lowest, low[lane]);
      highest = std::max(highest, high[lane]);
    }
    square += (highest - lowest) * (highest - lowest);
  }
  constexpr double skin = SKIN * (1.0 - ROUNDING);
  return !(square < skin * skin);
}

/* ---------------------------------------------------------------------- */

void LSMNearPairs::update(bigint build, const NeighList &list, const double *x, int count,
                          const double *radius, double reach, const int *const *touch)
{
  if (build == built && (held.empty() || !outdated(x))) return;
  if (build != built) {
    bigint all = 0;
    for (int ii = 0; ii < list.inum; ii++) all += list.numneigh[list.ilist[ii]];
    held.resize(all > FEW * count ? 3 * static_cast<size_t>(count) : 0);
  }
  built = build;
  std::copy_n(x, held.size(), held.begin());

  particles.clear();
  pairs.clear();
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    const int first = static_cast<int>(pairs.size());
    const double *const xi = x + 3 * static_cast<size_t>(i);
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const double *const xj = x + 3 * static_cast<size_t>(j);
      const double dx = xi[0] - xj[0], dy = xi[1] - xj[1], dz = xi[2] - xj[2];
      const double far = reach * (radius[i] + radius[j]) + SKIN;
      const bool left_out = dx * dx + dy * dy + dz * dz > far * far && !(touch && touch[i][jj]);
      if (held.empty() || !left_out) pairs.push_back(jj);
    }
    const int last = static_cast<int>(pairs.size());
    if (last > first) particles.push_back({i, first, last});
  }
}
