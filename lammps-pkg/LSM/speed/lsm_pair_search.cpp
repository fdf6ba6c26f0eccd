// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_pair_search.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "lsm_link_kernel.h"
#include "my_page.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "npair_bin.h"

#include <cmath>
#include <typeinfo>
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

// Defines LAMMPS' name of its search, a template whose parameters differ between versions.
namespace LAMMPS_NS {
#define NPAIR_CLASS
#define NPairStyle(key, Class, mask)
#include "npair_bin.h"
#undef NPairStyle
#undef NPAIR_CLASS
}    // namespace LAMMPS_NS

using namespace LAMMPS_NS;
using namespace NeighConst;

namespace {

// Gives access to a protected member, as class Neighbor has no interface for replacing a search.
struct Searches : Neighbor {
  static NPair **of(Neighbor *neighbor) { return neighbor->*(&Searches::neigh_pair); }
};

// Other versions may order their lists differently, so they keep their own search.
constexpr int VERSION = 20250204;

// Errors of coordinates in single precision are less than this fraction of the largest coordinate.
constexpr double ROUNDING = 1e-6;

constexpr int LANES = 8;    // particles that are tested together

}    // namespace

// Collects the particles that may be in the list of particle i, and returns their number. It is not
// called without AVX2.
#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) int LSMPairSearch::find(int i, float xi, float yi, float reach)
{
  const __m256 x8 = _mm256_set1_ps(xi), y8 = _mm256_set1_ps(yi), reach8 = _mm256_set1_ps(reach);
  const __m256i i8 = _mm256_set1_epi32(i);
  int *to = found.data();
  for (const auto &[first, last] : rows) {
    const int end = begin[atom2bin[i] + last + 1];
    for (int n = begin[atom2bin[i] + first]; n < end; n += LANES) {
      const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(&place[0][n]), x8);
      const __m256 dy = _mm256_sub_ps(_mm256_loadu_ps(&place[1][n]), y8);
      const __m256 most = _mm256_add_ps(_mm256_loadu_ps(&size[n]), reach8);
      const __m256i j8 = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(&number[n]));
      const __m256 near = _mm256_cmp_ps(_mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)),
                                        _mm256_mul_ps(most, most), _CMP_LE_OQ);
      const __m256 later = _mm256_castsi256_ps(_mm256_cmpgt_epi32(j8, i8));
      int marks = _mm256_movemask_ps(_mm256_and_ps(near, later));
      if (end - n < LANES) marks &= (1 << (end - n)) - 1;
      for (; marks; marks &= marks - 1) *to++ = number[n + __builtin_ctz(marks)];
    }
  }
  return static_cast<int>(to - found.data());
}
#else
int LSMPairSearch::find(int, float, float, float)
{
  return 0;
}
#endif

LSMPairSearch::LSMPairSearch(LAMMPS *_lmp, NPair *other) : NPair(_lmp), stock(other)
{
  istyle = other->istyle;
  nb = other->nb;
  ns = other->ns;
  last_build = other->last_build;
  cutoff_custom = 0.0;    // set by post_constructor() only, from a request
  copy_neighbor_info();
}

// A list that skips some types is derived from one with all types, which is the one to be replaced.
void LSMPairSearch::take_over(LAMMPS *lmp, NeighList &wanted)
{
  NeighList &list = wanted.listskip ? *wanted.listskip : wanted;
  NPair *&search = Searches::of(lmp->neighbor)[list.index];
  if (lmp->num_ver != VERSION || !LSMLinkKernel::has_avx2() || lmp->domain->dimension != 2 ||
      !search || typeid(*search) != typeid(NPairHalfSizeBinNewtoff))
    return;
  list.np = search = new LSMPairSearch(lmp, search);
}

void LSMPairSearch::copy_neighbor_info()
{
  NPair::copy_neighbor_info();
  stock->copy_neighbor_info();
}

// Sorts particles by bins, in each bin in LAMMPS' order, so that consecutive bins of the stencil
// are contiguous in memory.
void LSMPairSearch::sort_particles()
{
  const size_t count = atom->nlocal + atom->nghost;
  begin.assign(1, 0);
  number.clear();
  for (int bin = 0; bin < mbins; bin++) {
    for (int j = binhead[bin]; j >= 0; j = bins[j]) number.push_back(j);
    begin.push_back(static_cast<int>(number.size()));
  }
  number.resize(count + LANES, -1);    // so that all lanes of the last vector can be read
  for (auto *values : {&place[0], &place[1], &size}) values->resize(count + LANES);
  for (size_t n = 0; n < count; n++) {
    const int j = number[n];
    for (int c = 0; c < 2; c++) place[c][n] = static_cast<float>(atom->x[j][c]);
    size[n] = static_cast<float>(atom->radius[j]);
  }
  rows.clear();
  for (int k = 0; k < nstencil; k++)
    if (rows.empty() || rows.back().second != stencil[k] - 1)
      rows.push_back({stencil[k], stencil[k]});
    else
      rows.back().second = stencil[k];
}

void LSMPairSearch::build(NeighList *list)
{
  if (exclude || includegroup || molecular == Atom::TEMPLATE) {
    stock->build_setup();
    stock->build(list);
    return;
  }
  sort_particles();
  double farthest = skin;
  for (int c = 0; c < 2; c++)
    farthest += std::fabs(bboxlo[c]) + std::fabs(bboxhi[c]) + neighbor->cutneighmax;
  const double margin = skin + ROUNDING * farthest;
  double **const x = atom->x, *const radius = atom->radius;
  found.resize(number.size());

  list->ipage->reset();
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; i++) {
    int n = 0, *const entries = list->ipage->vget();
    const int count = find(i, static_cast<float>(x[i][0]), static_cast<float>(x[i][1]),
                           static_cast<float>(radius[i] + margin));
    for (int m = 0; m < count; m++) {
      const int j = found[m];
      const double delx = x[i][0] - x[j][0], dely = x[i][1] - x[j][1], delz = x[i][2] - x[j][2];
      const double rsq = delx * delx + dely * dely + delz * delz;
      const double radsum = radius[i] + radius[j], cut = radsum + skin;
      if (!(rsq <= cut * cut)) continue;
      int entry = list->history && rsq < radsum * radsum ? j ^ (1 << HISTBITS) : j;
      if (molecular != Atom::ATOMIC) {
        const int which = find_special(atom->special[i], atom->nspecial[i], atom->tag[j]);
        if (which != 0 && !domain->minimum_image_check(delx, dely, delz)) {
          if (which < 0) continue;
          entry ^= which << SBBITS;
        }
      }
      entries[n++] = entry;
    }
    list->ilist[i] = i;
    list->firstneigh[i] = entries;
    list->numneigh[i] = n;
    list->ipage->vgot(n);
    if (list->ipage->status()) error->one(FLERR, "Neighbor list overflow, boost neigh_modify one");
  }
  list->inum = nlocal;
}
