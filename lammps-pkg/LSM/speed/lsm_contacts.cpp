// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_contacts.h"

#include <utility>

using namespace LAMMPS_NS;

void LSMContacts::begin(int size, int dimension)
{
  state_size = size;
  dim = dimension;
  pairs.clear();
  ends.clear();
  limit.clear();
  states.clear();
  at_last_find = 0;
  begun_++;
}

void LSMContacts::add(const Pair &pair, bool touching)
{
  pairs.push_back(pair);
  ends.push_back({3 * pair.i, 3 * pair.j});
  limit.push_back(touching ? std::numeric_limits<double>::infinity() : within(pair.r0));
  states.resize(states.size() + state_size, 0.0);
}

void LSMContacts::find(const double *x)
{
  dim == 3 ? find_in<3>(x) : find_in<2>(x);
}

// Whether a pair touches is unpredictable for the processor, so the loop has no branches.
template <int DIM> void LSMContacts::find_in(const double *x)
{
  found.resize(pairs.size());
  for (auto &of_a_step : vectors) of_a_step.resize(DIM * pairs.size());
  newest = 1 - newest;
  const Ends *const end = ends.data();
  const double *const most = limit.data();
  double *const vector = vectors[newest].data();
  int *const to = found.data();
  const int n = count();
  before = std::exchange(at_last_find, n);
  int touching = 0;
  for (int m = 0; m < n; m++) {
    const double *const a = x + end[m].i, *const b = x + end[m].j;
    const double dx = a[0] - b[0], dy = a[1] - b[1];
    double square = dx * dx + dy * dy;
    vector[DIM * m] = dx;
    vector[DIM * m + 1] = dy;
    if constexpr (DIM == 3) {
      const double dz = a[2] - b[2];
      square += dz * dz;
      vector[DIM * m + 2] = dz;
    }
    to[touching] = m;    // overwritten by the next one unless the number advances
    touching += !(square > most[m]);
  }
  number = touching;
}
