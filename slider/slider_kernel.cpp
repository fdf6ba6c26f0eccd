// SPDX-License-Identifier: GPL-2.0-or-later
// One time step, compiled for each instruction set SLIDER_SET with SLIDER_LANES lanes per register.
// Nothing here calls a function that may stay one: the linker would take one set's copy for all.
#include "slider_kernels.h"

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

inline __attribute__((always_inline)) Lanes load(const double *p) {
  Lanes a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
inline __attribute__((always_inline)) void store(double *p, const Lanes &a) {
  std::memcpy(p, &a, sizeof a);
}
// One instruction: the compiler is told that errno is not used.
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

// Friction of a register of blocks after the given slips, that of a block at rest with f <= m being
// at least f.
template <Law law>
inline __attribute__((always_inline)) Register friction(const ChainView &chain, Register m,
                                                        Register v, Register f, Register slip) {
  const Register zero = {}, low = chain.friction.dynamic * m;
  if constexpr (law == Law::coulomb)
    return LSM::CoulombStatic::friction(m, low, (v > zero) | (f > m));
  else if constexpr (law == Law::slip_weakening)
    return LSM::SlipWeakening::strength(m, low, zero + chain.friction.dc, slip);
  else
    return LSM::VelocityWeakening::friction(m, v);
}

template <Scheme scheme, Law law>
StepSums step(const ChainView &chain, const std::int32_t *list, int count, double x_new,
              std::uint8_t *hot) {
  const Register zero = {};
  const double h = chain.dt;
  const double h_m = h / chain.mass;
  const double half_h = 0.5 * h;
  const double half_h_m = half_h / chain.mass;
  const double kc = chain.kc, kl = chain.kl;
  double *const u = chain.u, *const velocity = chain.v, *const force = chain.force;
  const double *const mu = chain.mu;
  constexpr bool needs_rest = law == Law::slip_weakening;
  // Blocks move (the first half of the step), then their springs pull. A chunk is pulled some
  // chunks after it was moved: its neighbours have been moved by then, its data are still in the
  // nearest cache, and the stores of its displacements have completed, so that loads across two
  // chunks do not wait for them. The first chunk of the chain, a neighbour of the last, comes last.
  constexpr int lag = 6;
  constexpr int ahead = 12;     // chunks in the list between fetching into the cache and moving
  constexpr unsigned ring = 8;  // more than lag
  static_assert(ring > lag);
  const auto move = [&](int k, Lanes &change) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    const Lanes f = load(force + i), m = load(mu + i), v = load(velocity + i);
    Lanes x = load(u + i);
    [[maybe_unused]] Lanes rest;
    if constexpr (needs_rest) rest = load(chain.rest + i);
    for (int r = 0; r < registers; ++r) {
      Register slid = zero;
      if constexpr (needs_rest) slid = x.r[r] - rest.r[r];
      // A stuck block has v = 0, so f <= mu leaves it stuck without a branch, and a block whose
      // velocity would turn negative sticks.
      const Register push = f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r], slid);
      Register w = v.r[r] + (scheme == Scheme::verlet ? half_h_m : h_m) * push;
      w = w > zero ? w : zero;
      const Register moved = scheme == Scheme::printed ? half_h * (v.r[r] + w) : h * w;
      const Register next = x.r[r] + moved;
      change.r[r] = next - x.r[r];
      x.r[r] = next;
      std::memcpy(velocity + i + r * SLIDER_LANES, &w, sizeof w);
    }
    store(u + i, x);
  };

  Lanes work = {}, slip = {};
  StepSums sums = {0.0, 0.0, 0};
  const auto pull = [&](int k, const Lanes &change) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    const Lanes x = load(u + i), left = load(u + i - 1), right = load(u + i + 1);
    const Lanes old = load(force + i), m = load(mu + i);
    Lanes v = load(velocity + i), f;
    [[maybe_unused]] Lanes rest;
    if constexpr (needs_rest) rest = load(chain.rest + i);
    unsigned lanes = 0;
    for (int r = 0; r < registers; ++r) {
      f.r[r] = kc * ((left.r[r] - x.r[r]) + (right.r[r] - x.r[r])) + kl * (x_new - x.r[r]);
      if (scheme == Scheme::verlet && law != Law::velocity_weakening) {
        // A block that came to rest in the first half of the step has healed.
        Register slid = zero;
        if constexpr (needs_rest) slid = v.r[r] > zero ? x.r[r] - rest.r[r] : zero;
        const Register w =
            v.r[r] + half_h_m * (f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r], slid));
        v.r[r] = w > zero ? w : zero;
      } else if (scheme == Scheme::verlet) {
        // w = v_half + h/2 (f - mu / (1 + w)) / m is quadratic in w; its larger root is written
        // without cancellation, so that its sign is that of c - b.
        const Register c = v.r[r] + half_h_m * f.r[r];
        const Register b = half_h_m * m.r[r];
        const Register q = (1.0 + c) * (1.0 + c) - 4.0 * b;
        const Register s = square_root(q > zero ? q : zero);
        const Register one = zero + 1.0;
        const Register fast = c > one ? one : zero;
        const Register numerator = fast > zero ? (c - 1.0) + s : 2.0 * (c - b);
        const Register denominator = fast > zero ? one + one : (1.0 - c) + s;
        Register w = numerator / denominator;
        w = ((w > zero) & (q > zero)) ? w : zero;
        v.r[r] = w;
      }
      if constexpr (needs_rest) rest.r[r] = v.r[r] > zero ? rest.r[r] : x.r[r];
      lanes |= bits((v.r[r] > zero) | (f.r[r] > m.r[r])) << (r * SLIDER_LANES);
      work.r[r] += (old.r[r] + f.r[r]) * change.r[r];
      slip.r[r] += change.r[r];
    }
    store(force + i, f);
    if (scheme == Scheme::verlet) store(velocity + i, v);
    if constexpr (needs_rest) store(chain.rest + i, rest);
    hot[k] = static_cast<std::uint8_t>(lanes);
    sums.hot += __builtin_popcount(lanes);
  };

  const auto fetch = [&](int k) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    __builtin_prefetch(u + i, 1);
    __builtin_prefetch(velocity + i, 1);
    __builtin_prefetch(force + i, 1);
    __builtin_prefetch(mu + i);
    if constexpr (needs_rest) __builtin_prefetch(chain.rest + i, 1);
  };

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

  double w[chunk_size], s[chunk_size];
  store(w, work);
  store(s, slip);
  sums.work = 0.5 * (((w[0] + w[4]) + (w[2] + w[6])) + ((w[1] + w[5]) + (w[3] + w[7])));
  sums.slip = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  return sums;
}

// By scheme, in the order of the enumeration.
template <Law law>
constexpr StepFunction steps_of[] = {step<Scheme::printed, law>, step<Scheme::semi_implicit, law>,
                                     step<Scheme::verlet, law>};

StepFunction function_of(Scheme scheme, Law law) {
  const auto &steps = law == Law::coulomb          ? steps_of<Law::coulomb>
                      : law == Law::slip_weakening ? steps_of<Law::slip_weakening>
                                                   : steps_of<Law::velocity_weakening>;
  return steps[static_cast<int>(scheme)];
}

}  // namespace Slider::SLIDER_SET
