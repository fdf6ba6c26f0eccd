// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "read_catalogue.h"
#include "scalar_chain.h"
#include "slider_chain.h"
#include "slider_creep.h"
#include "slider_run.h"

namespace Slider {
namespace {

constexpr double never_fast = 1e300;

/// Parameters with friction that never decreases, so that creep never becomes unstable.
Parameters even(int blocks) {
  Parameters p;
  p.blocks = blocks;
  p.friction.law = Law::coulomb;
  p.friction.dynamic = 1.0;
  return p;
}

double force(const Parameters &p, const std::vector<double> &u, std::size_t i, double plate) {
  return coupling_force(p, {}, u.data(), i) + p.kl * (plate - u[i]);
}

std::vector<double> displacements(Creep &creep, int blocks) {
  std::vector<double> u;
  for (int i = 0; i < blocks; ++i) u.push_back(creep.displacement(i));
  return u;
}

TEST(SliderCreep, SolvesTheProblemOfFriction) {
  // Forces are within the limits, and at the limit where a block has moved, and no block has moved
  // back: there is only one such state. The initial state has stresses, some beyond the limit.
  for (const int blocks : {1, 2, 3, 50, 200}) {
    const Parameters p = even(blocks);
    const auto mu = random_friction(blocks, 0.5, 1.0, 5);
    auto u0 = random_friction(blocks, 0.0, 0.2, 6);
    const double plate = 45.0;
    Creep creep(p, mu.data(), u0.data(), plate, never_fast);
    std::vector<double> limit = mu;
    for (std::size_t i = 0; i < mu.size(); ++i) limit[i] = std::max(mu[i], force(p, u0, i, plate));
    int joined = 0, checked = 0;
    for (double way = 0.0; way < 80.0; way += 1.0) {
      for (; creep.next() < way; ++joined) creep.join();
      creep.to(way);
      const auto u = displacements(creep, blocks);
      int moved = 0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        const double f = force(p, u, i, plate + way);
        ASSERT_GE(u[i], u0[i]);
        ASSERT_LE(f, limit[i] + 1e-11) << way << " " << i;
        if (u[i] == u0[i]) continue;
        ASSERT_NEAR(f, limit[i], 1e-11) << way << " " << i;
        ++moved;
      }
      checked += moved > 0 && moved < blocks;
      const double change = direct_energy(p, u, plate + way) - direct_energy(p, u0, plate);
      ASSERT_NEAR(creep.now().pe, change, 1e-11 * direct_energy(p, u0, plate)) << way;
    }
    EXPECT_EQ(creep.creeping(), blocks);
    if (blocks > 2) {
      EXPECT_GT(checked, 5);
      EXPECT_GT(joined, blocks / 2);
    }
  }
}

TEST(SliderCreep, IsTheLimitOfASlowPlate) {
  // Compares with all time steps taken, for slower and slower plates.
  double last = 0.0;
  for (const double velocity : {1e-2, 1e-3, 1e-4}) {
    Parameters p = even(40);
    p.velocity = velocity;
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 9);
    Chain chain(p, mu, false);
    const double way = 70.0;
    while (chain.plate() < way) chain.advance();
    const std::vector<double> u0(static_cast<std::size_t>(p.blocks), 0.0);
    Creep creep(p, mu.data(), u0.data(), 0.0, never_fast);
    while (creep.next() < chain.plate()) creep.join();
    creep.to(chain.plate());
    EXPECT_GT(creep.creeping(), 20);
    EXPECT_LT(creep.creeping(), 40);
    const auto u = chain.displacements();
    double error = 0.0, most = 0.0;
    for (int i = 0; i < p.blocks; ++i) {
      error = std::max(error, std::fabs(creep.displacement(i) - u[static_cast<std::size_t>(i)]));
      most = std::max(most, creep.displacement(i));
    }
    EXPECT_LT(error, 2.0 * velocity * most);
    if (last > 0.0) {
      EXPECT_LT(error, 0.2 * last);
    }
    last = error;
  }
}

/// A row of equally strong blocks, just at their limit, between blocks that never move.
struct Patch {
  Parameters p;
  std::vector<double> mu, u;
  explicit Patch(int length) {
    p.blocks = length + 2;
    p.velocity = 1e-9;
    p.dt = 0.01;
    mu.assign(static_cast<std::size_t>(p.blocks), 0.7);
    mu.front() = mu.back() = 1e6;
    u.assign(mu.size(), -69.99999);
  }
  bool gets_fast(double growth) const {
    Creep creep(p, mu.data(), u.data(), 0.0, growth * p.velocity);
    bool fast = false;
    for (int i = 1; i + 1 < p.blocks; ++i) fast = creep.join();
    return fast;
  }
  /// Largest velocity of a block in the first oscillation, in units of the plate velocity.
  double fastest() const {
    Chain chain(p, mu, true);
    ChainState s;
    s.u = u;
    for (double &x : s.u) x = -70.0;
    s.v.assign(u.size(), 0.0);
    chain.set_state(s);
    double v = 0.0;
    for (int n = 0; n < 20000; ++n) {
      chain.advance();
      const double now = chain.fastest();
      if (now == 0.0 && v > 0.0) break;
      v = std::max(v, now);
    }
    return v / p.velocity;
  }
};

TEST(SliderCreep, KnowsWhatGetsFast) {
  int turn = 0, run_away = 0;
  for (int length = 1; length <= 12; ++length) {
    const Patch patch(length);
    const double found = patch.fastest();
    double low = 1e-3, high = 1e12;
    while (high / low > 1.001) {
      const double middle = std::sqrt(low * high);
      (patch.gets_fast(middle) ? low : high) = middle;
    }
    // K_l + 2 K_c (1 - cos(pi / (n + 1))) < (mu / 2)^2 from 9 blocks on.
    // The estimate is for the slowest mode; the others add up to 5 %.
    if (length < 9) {
      EXPECT_NEAR(found / high, 1.03, 0.04) << length;
      ++turn;
    } else {
      EXPECT_GT(high, 0.9e12) << length;
      EXPECT_GT(found, 1e8) << length;
      ++run_away;
    }
  }
  EXPECT_EQ(turn, 8);
  EXPECT_EQ(run_away, 4);
}

TEST(SliderCreep, UnderCoulombFrictionAnyDropOfStrengthIsFast) {
  Patch one(1);
  Friction &law = one.p.friction;
  law = {Law::coulomb, 1.0};
  EXPECT_FALSE(one.gets_fast(10.0));
  law.dynamic = 0.99;
  EXPECT_TRUE(one.gets_fast(1e9));
}

RunOptions slow(int blocks, double velocity, double way) {
  RunOptions o;
  o.parameters.blocks = blocks;
  o.parameters.velocity = velocity;
  o.mu = random_friction(blocks, 0.5, 1.0, 1);
  o.steps = static_cast<std::int64_t>(way / velocity / o.parameters.dt);
  o.picker.lambda = 0.95;
  o.overwrite = true;
  return o;
}

/// Events above a size.
std::vector<LSM::Event> large_events(const RunOptions &o, double least) {
  std::vector<LSM::Event> large;
  for (const LSM::Event &e : unit::read_catalogue(o.catalogue).events)
    if (e.size >= least) large.push_back(e);
  return large;
}

TEST(SliderLeaps, FindTheSameLargeEvents) {
  // The motion of a chain is chaotic: another time step changes as much. The slip of one block on a
  // soft spring begins as slowly as the plate moves, and must not be held back.
  struct Case {
    int blocks;
    double velocity, way, least, shift, change;  // displacement of the plate, relative size
    std::size_t events;
  };
  for (const Case &c :
       {Case{256, 1e-3, 160.0, 100.0, 2.0, 0.25, 4}, {1, 1e-4, 400.0, 1.0, 0.1, 1e-3, 3}}) {
    RunOptions o = slow(c.blocks, c.velocity, c.way);
    o.catalogue = testing::TempDir() + "slider_leaps.csv";
    const RunResult all = run(o);
    const auto expected = large_events(o, c.least);
    ASSERT_GE(expected.size(), c.events);
    o.leap_speed = 1e-3;
    const RunResult leaps = run(o);
    const auto found = large_events(o, c.least);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].t_start * c.velocity, expected[k].t_start * c.velocity, c.shift) << k;
      EXPECT_NEAR(found[k].size / expected[k].size, 1.0, c.change) << k;
    }
    EXPECT_NEAR(leaps.pe, leaps.pe_direct, 1e-11 * leaps.pe);
    if (c.blocks == 1) continue;
    EXPECT_GT(leaps.leaps, 5);
    EXPECT_LT(20 * (leaps.steps - leaps.jumped - leaps.leapt), all.steps - all.jumped);
  }
}

TEST(SliderLeaps, HaveAnEndAsThePlateGetsSlower) {
  // The same events occur at the same plate displacements, at a cost that does not grow.
  std::vector<LSM::Event> last;
  double last_velocity = 0.0, shift = 0.0;
  for (const double velocity : {1e-5, 1e-6, 1e-7}) {
    RunOptions o = slow(256, velocity, 135.0);
    o.leap_speed = 1e-2;
    o.catalogue = testing::TempDir() + "slider_slow.csv";
    const RunResult r = run(o);
    EXPECT_LT(r.steps - r.jumped - r.leapt, 20000) << velocity;
    std::vector<LSM::Event> found = large_events(o, 500.0);
    ASSERT_GE(found.size(), 3U) << velocity;
    found.resize(3);
    for (std::size_t k = 0; k < last.size(); ++k)
      EXPECT_NEAR(found[k].size / last[k].size, 1.0, 0.01) << velocity << " " << k;
    if (!last.empty()) {
      double most = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most,
                        std::fabs(found[k].t_start * velocity - last[k].t_start * last_velocity));
      EXPECT_LT(most, 1.0);
      if (shift > 0.0) {
        EXPECT_LT(most, 0.5 * shift);
      }
      shift = most;
    }
    last = found;
    last_velocity = velocity;
  }
}

TEST(SliderLeaps, KnowTheEnergyWithin) {
  Parameters p = even(50);
  p.velocity = 1e-3;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 12);
  Chain chain(p, mu, false);
  const std::vector<double> u0(mu.size(), 0.0);
  const std::int64_t last = 1600000;  // a plate displacement of 80
  EXPECT_FALSE(chain.leap(last, last + 1, never_fast, true, true));
  EXPECT_FALSE(chain.leap(last, 1, never_fast, true, false));
  EXPECT_EQ(chain.step(), 0);
  ASSERT_TRUE(chain.leap(last, last, never_fast, false, true));
  EXPECT_EQ(chain.step(), last);
  Creep creep(p, mu.data(), u0.data(), 0.0, never_fast);
  for (std::int64_t step = 0; step <= last; step += 7919) {
    const double way = p.velocity * p.dt * static_cast<double>(step);
    while (creep.next() < way) creep.join();
    creep.to(way);
    const double direct = direct_energy(p, displacements(creep, p.blocks), way);
    ASSERT_NEAR(chain.pe_in_leap(step), direct, 1e-10) << step;
  }
  EXPECT_GT(creep.creeping(), 20);
  EXPECT_NEAR(chain.pe(), direct_energy(p, chain.displacements(), chain.plate()), 1e-10);
  double sum = 0.0;
  for (double u : chain.displacements()) sum += u;
  EXPECT_NEAR(chain.slip_sum(), sum, 1e-10);
  // It continues as a chain that is set to that state does.
  Chain set(p, mu, true);
  set.set_state(chain.state());
  for (int n = 0; n < 2000; ++n) {
    chain.advance();
    set.advance();
    ASSERT_EQ(chain.pe(), set.pe()) << n;
  }
  EXPECT_GT(chain.moved(), 1000);
}

}  // namespace
}  // namespace Slider
