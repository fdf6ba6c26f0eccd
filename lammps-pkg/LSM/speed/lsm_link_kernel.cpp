// SPDX-License-Identifier: GPL-2.0-or-later

// Functions with other instruction sets pass vectors differently: here all that take any are
// inlined.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

#include "lsm_link_kernel.h"

#include "numerics/sum.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

// The arithmetic becomes vector instructions only where sqrt() need not set errno
// (-fno-math-errno), and gives the same digits with each instruction set only without fused
// multiply-add (-ffp-contract=off). Vectors of 512 bits were measured to be slower: their roots
// take longer than twice those of 256.

#define LSM_INLINE inline __attribute__((always_inline))
#define LSM_LAMBDA __attribute__((always_inline))

namespace LAMMPS_NS {
namespace LSMLinkKernel {

  using LSMLinkRows::LANES;
  using LSMLinkRows::Rows;
  using LSMLinkRows::Stack;
  using Lanes = double __attribute__((vector_size(LANES * sizeof(double))));
  using Pair = double __attribute__((vector_size(2 * sizeof(double))));

  template <class Vector> LSM_INLINE static Vector load(const double *from)
  {
    Vector v;
    memcpy(&v, from, sizeof(v));
    return v;
  }

  template <class Vector> LSM_INLINE static void store(double *to, const Vector &v)
  {
    memcpy(to, &v, sizeof(v));
  }

  // four of the numbers of a and b, counted through both
  template <int I, int J, int K, int L, class Vector>
  LSM_INLINE static Lanes pick(const Vector &a, const Vector &b)
  {
#if defined(__clang__) || __GNUC__ >= 12
    return __builtin_shufflevector(a, b, I, J, K, L);
#else
    constexpr int n = sizeof(Vector) / sizeof(double);
    return Lanes{I < n ? a[I % n] : b[I % n], J < n ? a[J % n] : b[J % n],
                 K < n ? a[K % n] : b[K % n], L < n ? a[L % n] : b[L % n]};
#endif
  }

  // Positions of four particles, two coordinates per load.
  template <int DIM>
  LSM_INLINE static void gather(const double *x, const int *place, Lanes (&to)[DIM])
  {
    const Lanes a = pick<0, 1, 2, 3>(load<Pair>(x + place[0]), load<Pair>(x + place[2]));
    const Lanes b = pick<0, 1, 2, 3>(load<Pair>(x + place[1]), load<Pair>(x + place[3]));
    to[0] = pick<0, 4, 2, 6>(a, b);
    to[1] = pick<1, 5, 3, 7>(a, b);
    if constexpr (DIM == 3) {
      const double z[LANES] = {x[place[0] + 2], x[place[1] + 2], x[place[2] + 2], x[place[3] + 2]};
      to[2] = load<Lanes>(z);
    }
  }

  // Those of four particles that lie one after the other, as they are in memory.
  LSM_INLINE static void stretch_of(const double *x, int place, Lanes (&to)[3])
  {
    for (int c = 0; c < 3; c++) to[c] = load<Lanes>(x + place + c * LANES);
  }

  // Sum over the coordinates of each of four such particles.
  LSM_INLINE static Lanes sum_of_each(const Lanes &p, const Lanes &q, const Lanes &r)
  {
    const Lanes a = pick<0, 1, 6, 7>(p, q), b = pick<2, 3, 4, 5>(p, r), c = pick<0, 1, 6, 7>(q, r);
    return pick<0, 5, 2, 7>(a, b) + pick<1, 4, 3, 6>(a, c) + pick<0, 5, 2, 7>(b, c);
  }

  // Scalar products of the vectors of four particles.
  template <bool REGULAR, int DIM>
  LSM_INLINE static Lanes product(const Lanes (&a)[DIM], const Lanes (&b)[DIM])
  {
    if constexpr (REGULAR)
      return sum_of_each(a[0] * b[0], a[1] * b[1], a[2] * b[2]);
    else {
      Lanes sum = a[0] * b[0] + a[1] * b[1];
      if constexpr (DIM == 3) sum += a[2] * b[2];
      return sum;
    }
  }

  // One number for each of four particles times their vectors.
  template <bool REGULAR, int DIM>
  LSM_INLINE static void times(const Lanes &s, const Lanes (&d)[DIM], Lanes (&to)[DIM])
  {
    if constexpr (REGULAR) {
      to[0] = pick<0, 0, 0, 1>(s, s) * d[0];
      to[1] = pick<1, 1, 2, 2>(s, s) * d[1];
      to[2] = pick<2, 3, 3, 3>(s, s) * d[2];
    } else
      for (int c = 0; c < DIM; c++) to[c] = s * d[c];
  }

  // Differences of rows of Motion from those of the four particles `from`.
  LSM_INLINE static void gather(const double *x, const int *place, const double *const *from,
                                Lanes (&d)[2], Lanes (&u)[2])
  {
    Lanes of[LANES];
#pragma GCC unroll 4
    for (int c = 0; c < LANES; c++) of[c] = load<Lanes>(from[c]) - load<Lanes>(x + place[c]);
    const Lanes a = pick<0, 4, 2, 6>(of[0], of[1]), b = pick<1, 5, 3, 7>(of[0], of[1]);
    const Lanes e = pick<0, 4, 2, 6>(of[2], of[3]), g = pick<1, 5, 3, 7>(of[2], of[3]);
    u[0] = pick<0, 1, 4, 5>(a, e);
    u[1] = pick<0, 1, 4, 5>(b, g);
    d[0] = pick<2, 3, 6, 7>(a, e);
    d[1] = pick<2, 3, 6, 7>(b, g);
  }

  // Where the force of a particle is, by its place.
  template <int STRIDE> LSM_INLINE static double *force_at(double *f, int place)
  {
    constexpr int bytes = 3 * sizeof(double) / STRIDE;
    static_assert(bytes * STRIDE == 3 * sizeof(double), "places are multiples of this");
    return reinterpret_cast<double *>(reinterpret_cast<char *>(f) +
                                      static_cast<std::ptrdiff_t>(place) * bytes);
  }

  // Adds SIGN times the forces g to those of four particles, one after the other: two of them may
  // be the same.
  template <int SIGN, int STRIDE, bool REGULAR, int DIM>
  LSM_INLINE static void scatter(double *f, const int *place, const Lanes (&g)[DIM])
  {
    if constexpr (REGULAR) {
      for (int c = 0; c < DIM; c++) {
        double *const at = f + place[0] + c * LANES;
        store<Lanes>(at, SIGN > 0 ? load<Lanes>(at) + g[c] : load<Lanes>(at) - g[c]);
      }
      return;
    }
    const Lanes a = pick<0, 4, 2, 6>(g[0], g[1]), b = pick<1, 5, 3, 7>(g[0], g[1]);
    const Pair to[LANES] = {{a[0], a[1]}, {b[0], b[1]}, {a[2], a[3]}, {b[2], b[3]}};
#pragma GCC unroll 4
    for (int c = 0; c < LANES; c++) {
      double *const at = force_at<STRIDE>(f, place[c]);
      store<Pair>(at, SIGN > 0 ? load<Pair>(at) + to[c] : load<Pair>(at) - to[c]);
      if constexpr (DIM == 3) at[2] += SIGN * g[2][c];
    }
  }

  // State of the links of a slice in the pipeline.
  template <int LENGTH, bool VISCOUS> struct Rates {
  };
  template <int LENGTH> struct Rates<LENGTH, true> {
    Lanes rate[LENGTH];    // of the length, times the length
  };

  template <int DIM, int LENGTH, bool VISCOUS> struct Stage : Rates<LENGTH, VISCOUS> {
    Lanes d[LENGTH][DIM];    // from the partner to the particle of the row; in regular slices as
                             // in memory: x y z x | y z x y | z x y z
    Lanes r[LENGTH];         // square of its length, length, force over length
  };

  // Links rarely break: not worth code in the loop.
  template <class Law>
  __attribute__((noinline, cold)) static void
  note_broken(const Law &law, const Rows &rows, const Stack &stack, int slice, const double *r,
              std::vector<Found> &broken)
  {
    const int links = stack.length * LANES;
    for (int n = 0; n < links; n++) {
      const Found link = rows.link(stack, slice * links + n);
      if (law.is_broken(r[n], rows.rest[link.rest])) broken.push_back(link);
    }
  }

  // Software pipeline: slices pass four stations, each of which works on another slice, so that
  // every instruction finds its operands ready; one that waits for a root or a quotient would hold
  // up the hundred or so instructions after it. Stations are lambdas over local variables, as
  // members of a class would be kept in memory.
  //
  // In regular slices coordinates stay in the order of memory; only squares are brought side by
  // side. What is computed for each link, and the order of sums, is the same.
  template <int DIM, int LENGTH, bool FILLED_UP, bool BOTH, bool REGULAR, class Law>
  LSM_INLINE static double work_on(const Stack &stack, const Rows &rows, const Law &law,
                                   const double *x, double *f, std::vector<Found> &broken)
  {
    constexpr int STAGES = 4, STRIDE = Law::viscous ? Motion<DIM>::SIZE : 3;
    constexpr int STORED = REGULAR ? 1 : LANES;    // places
    constexpr bool PAIRED = Law::viscous && Motion<DIM>::HAS_POSITION;
    const double *motion = nullptr;
    if constexpr (Law::viscous) motion = law.motion;
    using Known = Stage<DIM, LENGTH, Law::viscous>;
    Known ring[STAGES];
    const int *row_in = &rows.particle[stack.row], *row_out = row_in;
    const int *other_in = &rows.other[stack.link], *other_out = other_in;
    const double *rest = &rows.rest[stack.rest];
    const int rest_step = Law::breaks ? LANES : stack.rest_step;
    Lanes twice{};                    // the energy
    [[maybe_unused]] Lanes lost{};    // the power

    const auto vectors = [&](int slice) LSM_LAMBDA {
      Known &s = ring[slice % STAGES];
      [[maybe_unused]] Lanes at[DIM], speed[DIM];
      [[maybe_unused]] const double *from[LANES];
      const auto get = [&](const double *of, const int *place, Lanes(&to)[DIM]) LSM_LAMBDA {
        if constexpr (REGULAR)
          stretch_of(of, place[0], to);
        else
          gather<DIM>(of, place, to);
      };
      if constexpr (PAIRED)
        for (int c = 0; c < LANES; c++) from[c] = motion + row_in[c];
      else
        get(x, row_in, at);
      if constexpr (Law::viscous && !PAIRED) get(motion, row_in, speed);
      row_in += STORED;
#pragma GCC unroll 4
      for (int n = 0; n < LENGTH; n++, other_in += STORED) {
        [[maybe_unused]] Lanes u[DIM];
        if constexpr (PAIRED)
          gather(motion, other_in, from, s.d[n], u);
        else {
          Lanes to[DIM];
          get(x, other_in, to);
          for (int c = 0; c < DIM; c++) s.d[n][c] = at[c] - to[c];
          if constexpr (Law::viscous) {
            get(motion, other_in, to);
            for (int c = 0; c < DIM; c++) u[c] = speed[c] - to[c];
          }
        }
        if constexpr (Law::viscous) s.rate[n] = product<REGULAR>(s.d[n], u);
        s.r[n] = product<REGULAR>(s.d[n], s.d[n]);
      }
    };

    const auto lengths = [&](int slice) LSM_LAMBDA {
      Known &s = ring[slice % STAGES];
#pragma GCC unroll 4
      for (int n = 0; n < LENGTH; n++) {
        const Lanes q = s.r[n];
        s.r[n] = Lanes{std::sqrt(q[0]), std::sqrt(q[1]), std::sqrt(q[2]), std::sqrt(q[3])};
      }
    };

    const auto springs = [&](int slice) LSM_LAMBDA {
      Known &s = ring[slice % STAGES];
      if constexpr (Law::breaks) {
        auto any = law.is_broken(s.r[0], load<Lanes>(rest));
        for (int n = 1; n < LENGTH; n++)
          any |= law.is_broken(s.r[n], load<Lanes>(rest + n * LANES));
        if (any[0] | any[1] | any[2] | any[3])
          note_broken(law, rows, stack, slice, reinterpret_cast<const double *>(s.r), broken);
      }
#pragma GCC unroll 4
      for (int n = 0; n < LENGTH; n++, rest += rest_step) {
        const Lanes r = s.r[n], r0 = load<Lanes>(rest);
        Lanes stretch = r - r0;
        if constexpr (FILLED_UP) stretch = r0 < LSMLinkRows::NO_LINK ? stretch : Lanes{};
        if constexpr (Law::breaks) stretch = law.is_broken(r, r0) ? Lanes{} : stretch;
        Lanes force = law.force(stretch);
        twice += force * stretch;
        if constexpr (Law::viscous) {
          Lanes rate = s.rate[n] / r;
          if constexpr (FILLED_UP) rate = r0 < LSMLinkRows::NO_LINK ? rate : Lanes{};
          if constexpr (Law::breaks) rate = law.is_broken(r, r0) ? Lanes{} : rate;
          const Lanes drag = law.drag(rate);
          lost += drag * rate;
          force += drag;
        }
        s.r[n] = force / r;
      }
    };

    const auto sums = [&](int slice) LSM_LAMBDA {
      const Known &s = ring[slice % STAGES];
      Lanes sum[DIM];
#pragma GCC unroll 4
      for (int n = 0; n < LENGTH; n++, other_out += STORED) {
        Lanes force[DIM];
        times<REGULAR>(s.r[n], s.d[n], force);
        for (int c = 0; c < DIM; c++) sum[c] = n ? sum[c] + force[c] : force[c];
        if constexpr (BOTH) scatter<1, STRIDE, REGULAR>(f, other_out, force);
      }
      scatter<-1, STRIDE, REGULAR>(f, row_out, sum);
      row_out += STORED;
    };

    int fetch = stack.fetch;
    const auto fetch_some = [&](int count) LSM_LAMBDA {
      for (; count > 0 && fetch < stack.fetch_end; count--, fetch++) {
        __builtin_prefetch((PAIRED ? motion : x) + rows.to_fetch[fetch]);
        __builtin_prefetch(force_at<STRIDE>(f, rows.to_fetch[fetch]), 1);
      }
    };

    const int slices = stack.slices;
    const int fetches = (stack.fetch_end - stack.fetch + slices - 1) / slices;
    for (int n = 0; n < slices + STAGES - 1; n++) {
      if (n >= 1 && n - 1 < slices) lengths(n - 1);
      if (n < slices) {
        fetch_some(fetches);
        vectors(n);
      }
      if (n >= 2 && n - 2 < slices) springs(n - 2);
      if (n >= 3) sums(n - 3);
    }
    if constexpr (Law::viscous)
      *law.lost += (BOTH ? 1.0 : 0.5) * ((lost[0] + lost[2]) + (lost[1] + lost[3]));
    return (twice[0] + twice[2]) + (twice[1] + twice[3]);
  }

  template <int DIM, class Law>
  LSM_INLINE static double work_on_all(const Rows &rows, Windows windows, const Law &law,
                                       bool first_only, const double *x, double *f,
                                       std::vector<Found> &broken)
  {
    constexpr int LONGEST = LSMLinkRows::LONGEST;
    LSM::NeumaierSum sum;
    for (int n = rows.windows[windows.first]; n < rows.windows[windows.last]; n++) {
      const Stack &stack = rows.stacks[n];
      double twice = 0.0;
      const auto by_length = [&](auto regular) LSM_LAMBDA {
        constexpr bool REGULAR = DIM == 3 && decltype(regular)::value;
        if (stack.length == 4)
          twice = work_on<DIM, 4, false, true, REGULAR>(stack, rows, law, x, f, broken);
        else if (stack.length == 3)
          twice = work_on<DIM, 3, false, true, REGULAR>(stack, rows, law, x, f, broken);
        else if (stack.length == 2)
          twice = work_on<DIM, 2, false, true, REGULAR>(stack, rows, law, x, f, broken);
        else
          twice = work_on<DIM, 1, false, true, REGULAR>(stack, rows, law, x, f, broken);
      };
      if (first_only)
        twice = work_on<DIM, LONGEST, true, false, false>(stack, rows, law, x, f, broken);
      else if (stack.filled_up)
        twice = work_on<DIM, LONGEST, true, true, false>(stack, rows, law, x, f, broken);
      else if (DIM == 3 && stack.regular)
        by_length(std::true_type());
      else
        by_length(std::false_type());
      sum.add((first_only ? 0.25 : 0.5) * twice);
    }
    return sum.value();
  }

  bool has_avx2()
  {
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
  }

  template <int DIM, class Law>
  LSM_AVX2 static double work_on_all_avx2(const Rows &rows, Windows windows, const Law &law,
                                          bool first_only, const double *x, double *f,
                                          std::vector<Found> &broken)
  {
    return work_on_all<DIM>(rows, windows, law, first_only, x, f, broken);
  }

  template <int DIM, class Law>
  double forces(const Rows &rows, Windows windows, const Law &law, bool first_only, const double *x,
                double *f, std::vector<Found> &broken, bool avx2)
  {
    return avx2 ? work_on_all_avx2<DIM>(rows, windows, law, first_only, x, f, broken)
                : work_on_all<DIM>(rows, windows, law, first_only, x, f, broken);
  }

#define LSM_INSTANTIATE(dim, law)                                                            \
  template double forces<dim, law>(const Rows &, Windows, const law &, bool, const double *, \
                                   double *, std::vector<Found> &, bool)
  LSM_INSTANTIATE(2, Elastic);
  LSM_INSTANTIATE(3, Elastic);
  LSM_INSTANTIATE(2, Breakable);
  LSM_INSTANTIATE(3, Breakable);
  LSM_INSTANTIATE(2, KelvinVoigt<Elastic>);
  LSM_INSTANTIATE(3, KelvinVoigt<Elastic>);
  LSM_INSTANTIATE(2, KelvinVoigt<Breakable>);
  LSM_INSTANTIATE(3, KelvinVoigt<Breakable>);

}    // namespace LSMLinkKernel
}    // namespace LAMMPS_NS
