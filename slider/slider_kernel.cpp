// SPDX-License-Identifier: GPL-2.0-or-later
// One time step, compiled once for each instruction set SLIDER_SET with SLIDER_LANES lanes per
// register. Every inline function called here must indeed be inlined: of the copies of one that is
// not, the linker would keep only one for the whole program, of an arbitrary instruction set.
#include "slider_kernels.h"
#include "slider_modes.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include <cstring>

namespace Slider::SLIDER_SET {

typedef double Register __attribute__((vector_size(8 * SLIDER_LANES)));
typedef long long Mask __attribute__((vector_size(8 * SLIDER_LANES)));
constexpr int registers = chunk_size / SLIDER_LANES;

struct Lanes {
  Register r[registers];
};

// Loads register by register. GCC copies larger structures through the stack 16 bytes at a time,
// and reading them back as registers stalls.
inline __attribute__((always_inline)) Register load_register(const double *p) {
  Register a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
inline __attribute__((always_inline)) void store_register(double *p, Register a) {
  std::memcpy(p, &a, sizeof a);
}
inline __attribute__((always_inline)) Lanes load(const double *p) {
  Lanes a;
  for (int r = 0; r < registers; ++r) a.r[r] = load_register(p + r * SLIDER_LANES);
  return a;
}
inline __attribute__((always_inline)) void store(double *p, const Lanes &a) {
  for (int r = 0; r < registers; ++r) store_register(p + r * SLIDER_LANES, a.r[r]);
}
// A single instruction, as -fno-math-errno is set.
inline __attribute__((always_inline)) Register square_root(Register a) {
  for (int l = 0; l < SLIDER_LANES; ++l) a[l] = __builtin_sqrt(a[l]);
  return a;
}
inline __attribute__((always_inline)) unsigned bits(Mask m) {
#if SLIDER_LANES == 8
  return _mm512_movepi64_mask((__m512i)m);
#elif SLIDER_LANES == 4
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
#elif defined(__x86_64__)
  return static_cast<unsigned>(_mm_movemask_pd((__m128d)m));
#else
  unsigned found = 0;
  for (int l = 0; l < SLIDER_LANES; ++l) found |= static_cast<unsigned>(m[l] & 1) << l;
  return found;
#endif
}

// Friction of a register of blocks. For a block at rest with f <= m it is at least f.
template <Law law>
inline __attribute__((always_inline)) Register friction(const ChainView &chain, Register m,
                                                        Register v, Register f) {
  const Register zero = {}, low = chain.friction.dynamic * m;
  if constexpr (law == Law::coulomb)
    return LSM::CoulombStatic::friction(m, low, (v > zero) | (f > m));
  else
    return LSM::VelocityWeakening::friction(m, v);
}

// The larger root of w = c - b / (1 + w), or 0 if there is none. The formula avoids cancellation,
// so that the sign of the root is that of c - b where c <= 1.
inline __attribute__((always_inline)) Register velocity_at(Register c, Register b) {
  const Register zero = {}, one = zero + 1.0;
  const Register q = (1.0 + c) * (1.0 + c) - 4.0 * b;
  const Register s = square_root(q > zero ? q : zero);
  const Mask fast = c > one;
  const Register numerator = fast ? (c - 1.0) + s : 2.0 * (c - b);
  const Register denominator = fast ? one + one : (1.0 - c) + s;
  const Register w = numerator / denominator;
  return ((w > zero) & (s > zero)) ? w : zero;
}

// Result of a step without inertia for a register of blocks.
struct Balance {
  Register v, ahead;
};

// Computes the velocities v at which radiation and friction balance the forces f at the end of a
// step, and the slips in the next step, in which forces are taken to change as they did in this one
// (Adams and Bashforth). A block that starts has missed the slip since its force exceeded its
// strength, and one that will stop slips only until then: the times of starts and stops are
// computed, as the scheme would be of order 1 without them.
// \param old forces at the beginning of the step
// \param slides blocks that have slid throughout the step
inline __attribute__((always_inline)) Balance balance(const ChainView &chain, Register m,
                                                      Register old, Register f, Mask slides) {
  const Register zero = {}, one = zero + 1.0;
  const double by_radiation = 1.0 / chain.radiation;
  const Register next = slides ? f + (f - old) : f;
  Register v = by_radiation * (f - friction<Law::coulomb>(chain, m, slides ? one : zero, f));
  v = v > zero ? v : zero;
  const Register last = by_radiation * (next - friction<Law::coulomb>(chain, m, v, f));
  const Mask stops = last < zero;
  Register part = one, late = zero;
  // Few blocks stop or start, and divisions are the most expensive operations here.
  if (bits(stops) != 0) part = stops ? v / (v - last) : one;
  const Register mean = stops ? 0.5 * v : 0.5 * (v + last);
  if (bits((v > zero) & ~slides) != 0) late = slides ? zero : old < m ? (f - m) / (f - old) : one;
  const Register ahead = chain.dt * (part * mean + late * v);
  // A negative sign marks a slip that ends with a stop.
  return {v, v > zero ? (stops ? -ahead : ahead) : zero};
}

template <Scheme scheme, Law law, bool by_modes, bool radiates = true>
StepSums step(const ChainView &chain, const std::int32_t *list, int count, double x_new,
              std::uint8_t *hot_lanes) {
  const Register zero = {};
  const double h = chain.dt;
  const double h_m = h / chain.mass;
  const double half_h = 0.5 * h;
  const double half_h_m = half_h / chain.mass;
  const double kc = chain.kc, kl = chain.kl;
  const double eta = chain.radiation;
  // The implicit half of a step is divided by this.
  [[maybe_unused]] const double slower = 1.0 / (1.0 + half_h_m * eta);
  double *const u = chain.u, *const velocity = chain.v, *const force = chain.force;
  const double *const mu = chain.mu;
  // Copied, because the compiler would otherwise read the members again after each store to
  // hot_lanes, which might alias them.
  const ModeArrays modes = chain.of_modes;
  double *const changed = chain.change;
  constexpr bool balances = scheme == Scheme::adams_bashforth;
  // Blocks move (the first half of the step), then their springs pull. `lag` chunks lie between the
  // chunk that is moved and the one that is pulled: its neighbours have been moved by then, its
  // data are still in the nearest cache, and the stores of its displacements have completed, so
  // that loads across two chunks do not wait for them. The first chunk of the chain, a neighbour of
  // the last, is pulled last.
  constexpr int lag = 6;
  constexpr int ahead = 12;     // chunks between the one being prefetched and the one being moved
  constexpr unsigned ring = 8;  // more than lag
  static_assert(ring > lag);
  Lanes work = {}, slip = {};
  // With modes, all chunks are listed.
  const auto place = [&](int k) __attribute__((always_inline)) {
    return static_cast<std::int64_t>(by_modes ? k : list[k]) * chunk_size;
  };
  const auto move = [&](int k, Lanes &change) __attribute__((always_inline)) {
    const std::int64_t i = place(k);
    const Lanes f = load(force + i), m = load(mu + i), v = load(velocity + i);
    Lanes x = load(u + i);
    for (int r = 0; r < registers; ++r) {
      Register moved;
      if constexpr (balances) {
        moved = load_register(chain.ahead + i + r * SLIDER_LANES);
        moved = moved < zero ? -moved : moved;
      } else {
        // A block at rest has v = 0, so that f <= mu leaves it at rest without a branch, and a
        // block whose velocity would become negative sticks.
        Register push = f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r]);
        if constexpr (radiates) push -= eta * v.r[r];
        Register w = v.r[r] + (scheme == Scheme::verlet ? half_h_m : h_m) * push;
        w = w > zero ? w : zero;
        moved = scheme == Scheme::printed ? half_h * (v.r[r] + w) : h * w;
        store_register(velocity + i + r * SLIDER_LANES, w);
      }
      const Register next = x.r[r] + moved;
      change.r[r] = next - x.r[r];
      x.r[r] = next;
    }
    store(u + i, x);
    return x;
  };

  StepSums sums;
  const auto pull = [&](int k, const Lanes &moved) __attribute__((always_inline)) {
    const std::int64_t i = place(k);
    Lanes change = moved;
    const Lanes x = load(u + i), m = load(mu + i);
    Lanes v = load(velocity + i), f;
    if constexpr (by_modes) {
      f = load(modes.coupling + i);
      for (int r = 0; r < registers; ++r) f.r[r] = f.r[r] + kl * (x_new - x.r[r]);
      if (hot_lanes[k] == 0) {
        Mask starts = {};
        for (int r = 0; r < registers; ++r) starts |= f.r[r] > m.r[r];
        if (bits(starts) == 0) {
          store(force + i, f);
          return;
        }
        hot_lanes[k] = 1;
        store(changed + i, change = {});
      } else {
        change = load(changed + i);
      }
    } else {
      const Lanes left = load(u + i - 1), right = load(u + i + 1);
      for (int r = 0; r < registers; ++r)
        f.r[r] = kc * ((left.r[r] - x.r[r]) + (right.r[r] - x.r[r])) + kl * (x_new - x.r[r]);
    }
    const Lanes old = load(force + i);
    unsigned lanes = 0;
    for (int r = 0; r < registers; ++r) {
      if constexpr (balances) {
        const Register planned = load_register(chain.ahead + i + r * SLIDER_LANES);
        const Mask slides = (v.r[r] > zero) & (planned >= zero);
        const Balance now = balance(chain, m.r[r], old.r[r], f.r[r], slides);
        store_register(chain.ahead + i + r * SLIDER_LANES, now.ahead);
        v.r[r] = now.v;
      } else if constexpr (scheme == Scheme::verlet && law == Law::velocity_weakening) {
        // w = v_half + h/2 (f - mu / (1 + w) - eta w) / m is quadratic in w.
        Register c = v.r[r] + half_h_m * f.r[r], b = half_h_m * m.r[r];
        if constexpr (radiates) {
          c *= slower;
          b *= slower;
        }
        v.r[r] = velocity_at(c, b);
      } else if constexpr (scheme == Scheme::verlet) {
        const Register push = f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r]);
        const Register w = slower * (v.r[r] + half_h_m * push);
        v.r[r] = w > zero ? w : zero;
      }
      lanes |= bits((v.r[r] > zero) | (f.r[r] > m.r[r])) << (r * SLIDER_LANES);
      work.r[r] += (old.r[r] + f.r[r]) * change.r[r];
      if constexpr (!by_modes) slip.r[r] += change.r[r];
    }
    store(force + i, f);
    if constexpr (scheme == Scheme::verlet || balances) store(velocity + i, v);
    hot_lanes[k] = static_cast<std::uint8_t>(lanes);
    sums.hot += __builtin_popcount(lanes);
  };

  const auto fetch = [&](int k) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    __builtin_prefetch(u + i, 1);
    __builtin_prefetch(velocity + i, 1);
    __builtin_prefetch(force + i, 1);
    __builtin_prefetch(mu + i);
  };

  const auto sum = [](const Lanes &lanes) __attribute__((always_inline)) {
    double l[chunk_size];
    store(l, lanes);
    return ((l[0] + l[4]) + (l[2] + l[6])) + ((l[1] + l[5]) + (l[3] + l[7]));
  };
  if constexpr (by_modes) {
    // Most chunks are at rest and have no hot lane.
    double common = 0.0;
    for (int k = 0; k < count; ++k) {
      const std::int64_t i = place(k);
      Lanes x;
      if (hot_lanes[k] != 0) {
        Lanes change;
        x = move(k, change);
        store(changed + i, change);
        for (int r = 0; r < registers; ++r) slip.r[r] += change.r[r];
      } else {
        x = load(u + i);
      }
      if (k == 0) common = u[0];
      for (Register &r : x.r) r -= common;
      store(modes.apart + i, x);
    }
    // Blocks never move backwards, so the sum tells whether any moved. While none moves, the
    // coupling forces stay the same.
    if (sum(slip) > 0.0) {
      chain.forces->transform();
      for (int n = 0; n < modes.values; n += chunk_size) {
        Lanes amplitudes = load(modes.spectrum + n);
        const Lanes factors = load(modes.factors + n);
        for (int r = 0; r < registers; ++r) amplitudes.r[r] *= factors.r[r];
        store(modes.spectrum + n, amplitudes);
      }
      chain.forces->transform_back();
    }
    for (int k = 0; k < count; ++k) pull(k, {});
  } else {
    Lanes first_change = {}, changes[ring];
    const int begin = count > 0 && list[0] == 0 ? 1 : 0;
    if (begin == 1) move(0, first_change);
    u[chain.blocks] = u[0];
    for (int k = begin; k < count + lag; ++k) {
      if (k + ahead < count) fetch(k + ahead);
      if (k < count) move(k, changes[static_cast<unsigned>(k) % ring]);
      if (k - lag >= begin) pull(k - lag, changes[static_cast<unsigned>(k - lag) % ring]);
    }
    u[-1] = u[chain.blocks - 1];
    if (begin == 1) pull(0, first_change);
  }

  sums.work = 0.5 * sum(work);
  sums.slip = sum(slip);
  return sums;
}

template <bool by_modes>
StepFunction verlet_of(const Parameters &p) {
  constexpr Law weakening = Law::velocity_weakening;
  if (p.friction.law == Law::coulomb) return step<Scheme::verlet, Law::coulomb, by_modes>;
  // The paper's chain does not pay for radiation.
  return p.radiation > 0.0 ? step<Scheme::verlet, weakening, by_modes>
                           : step<Scheme::verlet, weakening, by_modes, false>;
}

StepFunction function_of(const Parameters &p) {
  if (p.scheme == Scheme::printed)
    return step<Scheme::printed, Law::velocity_weakening, false, false>;
  if (p.scheme == Scheme::adams_bashforth) return step<Scheme::adams_bashforth, Law::coulomb, true>;
  return p.by_springs() ? verlet_of<false>(p) : verlet_of<true>(p);
}

}  // namespace Slider::SLIDER_SET
