// SPDX-License-Identifier: GPL-2.0-or-later
// One time step, compiled for each instruction set SLIDER_SET with SLIDER_LANES lanes per register.
// Nothing here calls a function that may stay one: the linker would take one set's copy for all.
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

// Register by register: all at once would go by 16 bytes at a time through the stack, and reading
// those back as registers stalls.
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

// The larger root of w = c - b / (1 + w), written without cancellation so that its sign is that of
// c - b where c <= 1; 0 if there is none.
inline __attribute__((always_inline)) Register velocity_at(Register c, Register b) {
  const Register zero = {}, one = zero + 1.0;
  const Register q = (1.0 + c) * (1.0 + c) - 4.0 * b;
  const Register s = square_root(q > zero ? q : zero);
  const Register fast = c > one ? one : zero;
  const Register numerator = fast > zero ? (c - 1.0) + s : 2.0 * (c - b);
  const Register denominator = fast > zero ? one + one : (1.0 - c) + s;
  const Register w = numerator / denominator;
  return ((w > zero) & (q > zero)) ? w : zero;
}

// How blocks are coupled, and whether they radiate.
enum class Kind { springs, radiating_springs, modes };

template <Scheme scheme, Law law, Kind kind>
StepSums step(const ChainView &chain, const std::int32_t *list, int count, double x_new,
              std::uint8_t *hot) {
  const Register zero = {};
  const double h = chain.dt;
  const double h_m = h / chain.mass;
  const double half_h = 0.5 * h;
  const double half_h_m = half_h / chain.mass;
  const double kc = chain.kc, kl = chain.kl;
  constexpr bool radiates = kind != Kind::springs, by_modes = kind == Kind::modes;
  const double eta = chain.radiation;
  // By which the implicit half of a step is divided.
  [[maybe_unused]] const double slower = 1.0 / (1.0 + half_h_m * eta);
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
  Lanes work = {}, slip = {};
  [[maybe_unused]] Lanes radiated = {};
  const auto move = [&](int k, Lanes &change) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    const Lanes f = load(force + i), m = load(mu + i), v = load(velocity + i);
    Lanes x = load(u + i);
    [[maybe_unused]] Lanes rest;
    if constexpr (needs_rest) rest = load(chain.rest + i);
    for (int r = 0; r < registers; ++r) {
      Register moved;
      if constexpr (scheme == Scheme::adams_bashforth) {
        Register before;
        std::memcpy(&before, chain.before + i + r * SLIDER_LANES, sizeof before);
        moved = h * (1.5 * v.r[r] - 0.5 * before);
        moved = moved > zero ? moved : zero;
        std::memcpy(chain.before + i + r * SLIDER_LANES, &v.r[r], sizeof before);
      } else {
        Register slid = zero;
        if constexpr (needs_rest) slid = x.r[r] - rest.r[r];
        // A stuck block has v = 0, so f <= mu leaves it stuck without a branch, and a block whose
        // velocity would turn negative sticks.
        Register push = f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r], slid);
        if constexpr (radiates) push -= eta * v.r[r];
        Register w = v.r[r] + (scheme == Scheme::verlet ? half_h_m : h_m) * push;
        w = w > zero ? w : zero;
        moved = scheme == Scheme::printed ? half_h * (v.r[r] + w) : h * w;
        std::memcpy(velocity + i + r * SLIDER_LANES, &w, sizeof w);
      }
      const Register next = x.r[r] + moved;
      change.r[r] = next - x.r[r];
      x.r[r] = next;
      if constexpr (radiates) radiated.r[r] += v.r[r] * change.r[r];
    }
    store(u + i, x);
  };

  StepSums sums;
  const auto pull = [&](int k, const Lanes &change) __attribute__((always_inline)) {
    const std::int64_t i = static_cast<std::int64_t>(list[k]) * chunk_size;
    const Lanes x = load(u + i), old = load(force + i), m = load(mu + i);
    Lanes v = load(velocity + i), f, left, right;
    if constexpr (by_modes) {
      left = load(chain.coupling + i);
    } else {
      left = load(u + i - 1);
      right = load(u + i + 1);
    }
    [[maybe_unused]] Lanes rest;
    if constexpr (needs_rest) rest = load(chain.rest + i);
    unsigned lanes = 0;
    for (int r = 0; r < registers; ++r) {
      if constexpr (by_modes)
        f.r[r] = left.r[r] + kl * (x_new - x.r[r]);
      else
        f.r[r] = kc * ((left.r[r] - x.r[r]) + (right.r[r] - x.r[r])) + kl * (x_new - x.r[r]);
      if constexpr (scheme == Scheme::adams_bashforth || scheme == Scheme::verlet) {
        // Without inertia, radiation and friction balance the springs.
        constexpr bool balance = scheme == Scheme::adams_bashforth;
        const double by_radiation = 1.0 / eta;
        Register w;
        if constexpr (law == Law::velocity_weakening) {
          // w = v_half + h/2 (f - mu / (1 + w) - eta w) / m is quadratic in w.
          Register c = balance ? by_radiation * f.r[r] : v.r[r] + half_h_m * f.r[r];
          Register b = (balance ? by_radiation : half_h_m) * m.r[r];
          if constexpr (radiates && !balance) {
            c *= slower;
            b *= slower;
          }
          w = velocity_at(c, b);
          // A block at rest stays so, though it could slide as well.
          if constexpr (balance) w = ((v.r[r] > zero) | (f.r[r] > m.r[r])) ? w : zero;
        } else {
          // A block that came to rest in the first half of the step has healed.
          Register slid = zero;
          if constexpr (needs_rest) slid = v.r[r] > zero ? x.r[r] - rest.r[r] : zero;
          const Register push = f.r[r] - friction<law>(chain, m.r[r], v.r[r], f.r[r], slid);
          w = balance ? by_radiation * push : v.r[r] + half_h_m * push;
          if constexpr (radiates && !balance) w *= slower;
          w = w > zero ? w : zero;
        }
        v.r[r] = w;
      }
      if constexpr (needs_rest) rest.r[r] = v.r[r] > zero ? rest.r[r] : x.r[r];
      lanes |= bits((v.r[r] > zero) | (f.r[r] > m.r[r])) << (r * SLIDER_LANES);
      work.r[r] += (old.r[r] + f.r[r]) * change.r[r];
      slip.r[r] += change.r[r];
      if constexpr (radiates) radiated.r[r] += v.r[r] * change.r[r];
    }
    store(force + i, f);
    if constexpr (scheme == Scheme::verlet || scheme == Scheme::adams_bashforth)
      store(velocity + i, v);
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

  if constexpr (by_modes) {
    Register moves = zero;
    for (int k = 0; k < count; ++k) {
      Lanes change;
      move(k, change);
      store(chain.change + static_cast<std::int64_t>(list[k]) * chunk_size, change);
      for (const Register &r : change.r) moves += r;
    }
    double moved = 0.0;
    for (int l = 0; l < SLIDER_LANES; ++l) moved += moves[l];
    // No block goes back. While none moves, the coupling stays.
    if (moved > 0.0) chain.forces->find(u, chain.coupling);
    for (int k = 0; k < count; ++k)
      pull(k, load(chain.change + static_cast<std::int64_t>(list[k]) * chunk_size));
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

  const auto sum = [](const Lanes &lanes) __attribute__((always_inline)) {
    double l[chunk_size];
    store(l, lanes);
    return ((l[0] + l[4]) + (l[2] + l[6])) + ((l[1] + l[5]) + (l[3] + l[7]));
  };
  sums.work = 0.5 * sum(work);
  sums.slip = sum(slip);
  if constexpr (radiates) sums.radiated = 0.5 * eta * sum(radiated);
  return sums;
}

template <Law law, Kind kind>
StepFunction of_scheme(Scheme scheme) {
  if (scheme == Scheme::verlet) return step<Scheme::verlet, law, kind>;
  if (scheme == Scheme::semi_implicit) return step<Scheme::semi_implicit, law, kind>;
  if constexpr (kind != Kind::springs)
    if (scheme == Scheme::adams_bashforth) return step<Scheme::adams_bashforth, law, kind>;
  return step<Scheme::printed, law, kind>;
}

template <Law law>
StepFunction of_law(const Parameters &p) {
  return !p.by_springs()     ? of_scheme<law, Kind::modes>(p.scheme)
         : p.radiation > 0.0 ? of_scheme<law, Kind::radiating_springs>(p.scheme)
                             : of_scheme<law, Kind::springs>(p.scheme);
}

StepFunction function_of(const Parameters &p) {
  const Law law = p.friction.law;
  return law == Law::coulomb          ? of_law<Law::coulomb>(p)
         : law == Law::slip_weakening ? of_law<Law::slip_weakening>(p)
                                      : of_law<Law::velocity_weakening>(p);
}

}  // namespace Slider::SLIDER_SET
