/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_link_kernel.h"

#include "lsm_force_laws.h"
#include "lsm_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

// The arithmetic becomes vector instructions only where sqrt() need not set errno (-fno-math-errno), and gives
// the same digits with each instruction set only without fused multiply-add (-ffp-contract=off).
// Vectors of 512 bits were measured to be no faster: loads and stores limit the loop.

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__)
#define LSM_CLONES __attribute__((target_clones("default", "avx2")))
#define LSM_INLINE inline __attribute__((always_inline))
#else
#define LSM_CLONES
#define LSM_INLINE inline
#endif

namespace LAMMPS_NS {
namespace LSMLinkKernel {

  // Links go through three stations in chunks: their vectors are taken from the positions; lengths, forces and
  // energies are computed; the forces are added to the particles. Each station works on another chunk, so that
  // the divisions and roots of one run beside the loads and stores of the others. Between the first and
  // the second lie some chunks, as a wide load right after the narrow stores of its parts would wait for them.

  constexpr int CHUNK = 16;
  constexpr int LEAD = 6;
  constexpr int LAG = 4;
  constexpr int RING = 16;    // more than LEAD + LAG

  // Vectors of one link. In two dimensions one machine vector, which keeps the compiler from gathering
  // and scattering over several links, slower here.

  struct Vector2 {
    double __attribute__((vector_size(16))) c;
    double operator[](int n) const { return c[n]; }
    Vector2 operator+(const Vector2 &o) const { return {c + o.c}; }
    Vector2 operator-(const Vector2 &o) const { return {c - o.c}; }
    Vector2 operator*(double s) const { return {c * s}; }
  };

  struct Vector3 {
    double c[3];
    double operator[](int n) const { return c[n]; }
    Vector3 operator+(const Vector3 &o) const
    {
      return {{c[0] + o.c[0], c[1] + o.c[1], c[2] + o.c[2]}};
    }
    Vector3 operator-(const Vector3 &o) const
    {
      return {{c[0] - o.c[0], c[1] - o.c[1], c[2] - o.c[2]}};
    }
    Vector3 operator*(double s) const { return {{c[0] * s, c[1] * s, c[2] * s}}; }
  };

  template <int DIM> using Vector = std::conditional_t<DIM == 2, Vector2, Vector3>;

  template <int DIM> LSM_INLINE static Vector<DIM> load(const double *from)
  {
    Vector<DIM> v;
    memcpy(&v, from, sizeof(v));
    return v;
  }

  template <int DIM> LSM_INLINE static void store(double *to, const Vector<DIM> &v)
  {
    memcpy(to, &v, sizeof(v));
  }

  template <int DIM> struct alignas(64) Stage {
    Vector<DIM> d[CHUNK];    // from j to i
    double rsq[CHUNK];       // its square
    double fbond[CHUNK];     // force on i over d
  };

  template <int DIM>
  LSM_INLINE static void gather(Stage<DIM> &s, const double *x, const Ends *end, int n = CHUNK)
  {
#pragma GCC unroll 8
    for (int l = 0; l < n; l++) {
      const Vector<DIM> d = load<DIM>(x + end[l].i) - load<DIM>(x + end[l].j);
      s.d[l] = d;
      double rsq = d[0] * d[0] + d[1] * d[1];
      if constexpr (DIM == 3) rsq += d[2] * d[2];
      s.rsq[l] = rsq;
    }
    for (int l = n; l < CHUNK; l++) s.rsq[l] = 1.0;
  }

  // Twice the energy of each link is added to the sum of its place in the chunk. A link that is broken is put
  // right afterwards.

  template <int DIM, bool BREAK>
  LSM_INLINE static void spring_forces(Stage<DIM> &s, const double *r0, const Links &links,
                                       int first, double *energy, std::vector<int> &broken,
                                       int n = CHUNK)
  {
    const double k = links.stiffness, ratio = links.ratio;
    const double *__restrict rsq = s.rsq, *__restrict rest = r0;
    double *__restrict fbond = s.fbond, *__restrict twice = energy;
    int any_broken = 0;
    for (int l = 0; l < CHUNK; l++) {
      const double r = std::sqrt(rsq[l]);
      const double stretch = r - rest[l];
      const double force = LSM::Spring::force(k, stretch);
      fbond[l] = -force / r;
      twice[l] += force * stretch;
      if constexpr (BREAK) any_broken |= LSM::link_is_broken(r, rest[l], ratio);
    }
    if constexpr (BREAK)
      if (any_broken)
        for (int l = 0; l < n; l++) {
          const double r = std::sqrt(rsq[l]);
          if (!LSM::link_is_broken(r, rest[l], ratio)) continue;
          twice[l] -= 2.0 * LSM::Spring::energy(k, r - rest[l]);
          fbond[l] = 0.0;
          broken.push_back(first + l);
        }
  }

  template <int DIM>
  LSM_INLINE static void scatter(const Stage<DIM> &s, double *f, const Ends *end, bool first_only,
                                 int n = CHUNK)
  {
#pragma GCC unroll 8
    for (int l = 0; l < n; l++) {
      const Vector<DIM> g = s.d[l] * s.fbond[l];
      double *const fi = f + end[l].i, *const fj = f + end[l].j;
      store<DIM>(fi, load<DIM>(fi) + g);
      if (!first_only) store<DIM>(fj, load<DIM>(fj) - g);
    }
  }

  // the lanes of the energy in the same order everywhere

  LSM_INLINE static void add_up(double *energy, LSM::NeumaierSum &sum)
  {
    for (int half = CHUNK / 2; half > 0; half /= 2)
      for (int l = 0; l < half; l++) energy[l] += energy[half + l];
    sum.add(0.5 * energy[0]);
    std::fill_n(energy, CHUNK, 0.0);
  }

  template <int DIM, bool BREAK>
  LSM_CLONES double forces(const Links &links, const double *x, double *f, std::vector<int> &broken)
  {
    constexpr int BLOCK_CHUNKS = BLOCK / CHUNK;
    const int chunks = links.count / CHUNK, rest = links.count % CHUNK;
    const int blocks = (links.count + BLOCK - 1) / BLOCK;
    Stage<DIM> ring[RING];
    alignas(64) double energy[CHUNK] = {0.0};
    LSM::NeumaierSum sum;

    for (int chunk = -LEAD; chunk < chunks + LAG; chunk++) {
      const int coming = chunk + LEAD, going = chunk - LAG;
      if (coming < chunks) {
        const int block = coming / BLOCK_CHUNKS;
        if (coming % BLOCK_CHUNKS == 0 && block + 1 < blocks)
          for (int m = links.to_fetch_begin[block + 1]; m < links.to_fetch_begin[block + 2]; m++) {
            __builtin_prefetch(x + links.to_fetch[m]);
            __builtin_prefetch(f + links.to_fetch[m], 1);
          }
        gather<DIM>(ring[coming % RING], x, links.ends + coming * CHUNK);
      }
      if (chunk >= 0 && chunk < chunks) {
        const int first = chunk * CHUNK;
        spring_forces<DIM, BREAK>(ring[chunk % RING], links.rest + first, links, first, energy,
                                  broken);
        if ((chunk + 1) % BLOCK_CHUNKS == 0) add_up(energy, sum);
      }
      if (going >= 0)
        scatter<DIM>(ring[going % RING], f, links.ends + going * CHUNK, links.first_only);
    }

    if (rest > 0) {
      const int first = chunks * CHUNK;
      double r0[CHUNK];
      for (int l = 0; l < CHUNK; l++) r0[l] = l < rest ? links.rest[first + l] : 1.0;
      gather<DIM>(ring[0], x, links.ends + first, rest);
      spring_forces<DIM, BREAK>(ring[0], r0, links, first, energy, broken, rest);
      scatter<DIM>(ring[0], f, links.ends + first, links.first_only, rest);
    }
    add_up(energy, sum);
    return links.first_only ? 0.5 * sum.value() : sum.value();
  }

  template double forces<2, false>(const Links &, const double *, double *, std::vector<int> &);
  template double forces<2, true>(const Links &, const double *, double *, std::vector<int> &);
  template double forces<3, false>(const Links &, const double *, double *, std::vector<int> &);
  template double forces<3, true>(const Links &, const double *, double *, std::vector<int> &);

}    // namespace LSMLinkKernel
}    // namespace LAMMPS_NS
