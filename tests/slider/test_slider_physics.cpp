// SPDX-License-Identifier: GPL-2.0-or-later
// The schemes beside closed forms and beside a reference that locates each start and stop.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "slider_ways.h"
#include "slider_chain.h"
#include "switching_chain.h"

namespace Slider {
namespace {

// Displacements at the end of a run with any scheme.
std::vector<double> final_state(Parameters p, const AnyScheme &scheme, double h, double time,
                                const std::vector<double> &mu, const std::vector<double> &start) {
  p.dt = h;
  return with_chain(p, mu, scheme, [&](auto &chain) {
    chain.set_state(at_rest(p, start));
    for (long n = 0; n < std::lround(time / h); ++n) chain.advance();
    return chain.displacements();
  });
}

double largest_difference(const std::vector<double> &a, const std::vector<double> &b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

TEST(SliderPhysics, BlockWithoutFrictionFollowsClosedForm) {
  // M U'' = K_l V t - K U from rest. One block has its leaf spring, and two more springs between
  // neighbours that are stuck, whether they lead to one neighbour (N = 2) or two.
  struct Case {
    AnyScheme scheme;
    double step, tolerance;
  };
  for (const int blocks : {1, 2, 3, 5})
    for (const Case &c : {Case{Scheme::printed, 0.002, 2e-3},
                          {Scheme::verlet, 0.001, 1e-6},
                          {Located::rk4, 0.01, 1e-10},
                          {Located::reference, 0.1, 1e-12}}) {
      Parameters p;
      p.blocks = blocks;
      p.kl = blocks > 1 ? 0.05 : 0.7;
      p.mass = 1.3;
      p.velocity = 0.2;
      std::vector<double> mu(static_cast<std::size_t>(blocks), 1000.0);
      mu[0] = 0.0;
      const double k = blocks > 1 ? 2.0 * p.kc + p.kl : p.kl, w = std::sqrt(k / p.mass), t = 20.0;
      const std::vector<double> start(mu.size(), 0.0),
          u = final_state(p, c.scheme, c.step, t, mu, start);
      EXPECT_NEAR(u[0], p.kl * p.velocity / k * (t - std::sin(w * t) / w), c.tolerance)
          << name_of(c.scheme) << " " << blocks;
      for (std::size_t i = 1; i < u.size(); ++i) EXPECT_EQ(u[i], 0.0);
    }
}

TEST(SliderPhysics, LoadingAndOnsetOfOneBlock) {
  for (const Scheme scheme : {Scheme::printed, Scheme::verlet}) {
    Parameters p;
    p.blocks = 1;
    p.dt = 0.01;
    p.scheme = scheme;
    Chain chain(p, {0.6}, false);
    // K_l V t exceeds mu after t = 6000.
    for (; chain.slip_sum() == 0.0 && chain.time() < 7000.0; chain.advance()) {
      const double expected = 0.5 * p.kl * chain.plate() * chain.plate();
      ASSERT_NEAR(chain.pe(), expected, 1e-13 * (1.0 + expected));
    }
    EXPECT_NEAR(chain.time(), 6000.0, 3.0 * p.dt) << to_string(scheme);
  }
}

TEST(SliderPhysics, EqualBlocksMoveAsOne) {
  Parameters p;
  p.velocity = 0.05;
  p.blocks = 1;
  Chain one(p, {0.7}, false);
  p.blocks = 37;
  Chain many(p, std::vector<double>(37, 0.7), false);
  for (int n = 0; n < 100000; ++n) {
    one.advance();
    many.advance();
  }
  ASSERT_GT(one.slip_sum(), 100.0);
  for (const double u : many.displacements()) EXPECT_EQ(u, one.displacements()[0]);
  EXPECT_NEAR(many.pe(), 37.0 * one.pe(), 1e-10 * many.pe());
}

TEST(SliderPhysics, OrdersOnOneEvent) {
  // One block begins just above its limit, the others just below theirs. Without inertia velocities
  // jump when blocks start.
  struct Case {
    AnyScheme scheme;
    bool modes;
    Friction friction;
    double radiation, mass, time, first, order, last;
  };
  const Friction weakening, coulomb = {Law::coulomb, 0.6}, flat = {Law::coulomb, 1.0};
  constexpr Scheme verlet = Scheme::verlet, quasi = Scheme::adams_bashforth;
  for (const Case &c : {Case{Scheme::printed, false, weakening, 0.0, 1.0, 12.8, 0.1, 1.0, 2e-2},
                        {verlet, false, weakening, 0.0, 1.0, 12.8, 0.1, 2.0, 1e-4},
                        {Located::rk4, false, weakening, 0.0, 1.0, 12.8, 0.1, 4.0, 1e-8},
                        {Located::reference, false, weakening, 0.0, 1.0, 12.8, 0.025, 0.0, 1e-11},
                        {verlet, true, weakening, 0.0, 1.0, 12.8, 0.1, 2.0, 1e-3},
                        {verlet, true, weakening, 0.3, 1.0, 12.8, 0.1, 2.0, 1e-3},
                        {quasi, true, coulomb, 0.6, 0.0, 3.2, 0.05, 2.0, 1e-3},
                        {quasi, true, flat, 0.6, 0.0, 3.2, 0.05, 2.0, 1e-3}}) {
    Parameters p = c.modes ? coupled(Coupling::antiplane, 12, 0.1) : Parameters();
    p.blocks = 12;
    p.kl = 0.1;
    p.friction = c.friction;
    p.radiation = c.radiation;
    p.mass = c.mass;
    const auto mu = random_friction(12, 0.5, 1.0, 7);
    std::vector<double> start, errors;
    for (int i = 0; i < 12; ++i) start.push_back(-6.0 + 0.3 * std::sin(2.0 * i));
    start[3] = -6.6;
    const auto exact = final_state(p, Located::reference, 0.1, c.time, mu, start);
    const double slip = largest_difference(exact, start);
    EXPECT_GT(slip, c.mass > 0.0 ? 1.0 : 0.1);
    for (int k = 0; k < (c.order > 0.0 ? 6 : 1); ++k) {
      const auto u = final_state(p, c.scheme, c.first / (1 << k), c.time, mu, start);
      errors.push_back(largest_difference(u, exact) / slip);
    }
    const double order = std::log2(errors.front() / errors.back()) / 5.0;
    const std::string what = std::string(name_of(c.scheme)) + (c.modes ? " modes " : " springs ") +
                             to_string(c.friction.law) + " " + std::to_string(c.radiation);
    if (c.order > 0.0) {
      EXPECT_NEAR(order, c.order, 0.25) << what;
    }
    EXPECT_LT(errors.back(), c.last) << what;
  }
}

TEST(SliderPhysics, NoBackSlip) {
  Parameters p;
  p.blocks = 40;
  p.velocity = 0.1;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 3);
  for (const AnyScheme scheme : {AnyScheme(Scheme::printed), AnyScheme(Scheme::verlet)})
    with_chain(p, mu, scheme, [&](auto &chain) {
      std::vector<double> before = chain.displacements(), v_before = chain.velocities();
      int stops = 0;
      for (int n = 0; n < 30000; ++n) {
        chain.advance();
        const auto u = chain.displacements(), v = chain.velocities();
        for (std::size_t i = 0; i < u.size(); ++i) {
          ASSERT_GE(u[i], before[i]) << name_of(scheme) << " step " << n;
          ASSERT_GE(v[i], 0.0) << name_of(scheme) << " step " << n;
          stops += v[i] == 0.0 && v_before[i] > 0.0;
        }
        before = u;
        v_before = v;
      }
      EXPECT_GT(stops, 20) << name_of(scheme);
    });
}

TEST(SliderPhysics, BlockPushedBackwardsStaysStuck) {
  Parameters p;
  p.blocks = 3;
  p.dt = 0.01;
  for (const Scheme scheme : {Scheme::printed, Scheme::verlet})
    // The first block is ahead by 2 and pushed back with a force of 4, less and more than its
    // strength; the others are pulled forward by 2 each.
    for (const double strength : {5.0, 3.0}) {
      p.scheme = scheme;
      Chain chain(p, {strength, strength, strength}, false);
      chain.set_state(at_rest(p, {2.0, 0.0, 0.0}));
      for (int n = 0; n < 1000; ++n) chain.advance();
      EXPECT_EQ(chain.displacements()[0], 2.0) << strength;
      EXPECT_EQ(chain.moved(), 0) << strength;
    }
}

TEST(SliderPhysics, PrintedSchemeStopsABlockWithTheAccelerationThatStopsIt) {
  // Eqs. 7 and 8 with a = f - mu_0 / (1 + v), or a = -v/h where the block would move back: one
  // block in the middle of a slip, fast or slow, after one step.
  Parameters p;
  p.scheme = Scheme::printed;
  p.dt = 0.01;
  p.blocks = 1;
  const double h = p.dt, force = 0.2;
  for (const double v : {0.5, 0.001}) {
    Chain chain(p, {0.8}, false);
    ChainState s = at_rest(p, {-force / p.kl});
    s.v[0] = v;
    chain.set_state(s);
    chain.advance();
    const double a = std::fmax(force - 0.8 / (1.0 + v), -v / h);
    EXPECT_NEAR(chain.velocities()[0], v + h * a, 1e-15);
    EXPECT_EQ(chain.velocities()[0] == 0.0, v < 0.01);
    EXPECT_NEAR(chain.displacements()[0] - s.u[0], h * v + 0.5 * h * h * a, 1e-14);
  }
}

TEST(SliderPhysics, PeriodsOfOneBlockAreThoseOfTheReference) {
  for (const Friction &friction : {Friction{}, Friction{Law::coulomb, 0.75}}) {
    Parameters p;
    p.blocks = 1;
    p.kl = 0.05;
    p.friction = friction;
    std::vector<double> periods;
    for (const AnyScheme scheme : {AnyScheme(Scheme::verlet), AnyScheme(Located::reference)})
      periods.push_back(with_chain(p, {0.8}, scheme, [](auto &chain) {
        std::vector<double> starts;  // of slips after rest
        double before = 0.0;
        for (bool rested = true; starts.size() < 4 && chain.time() < 50000.0;) {
          chain.advance();
          const double now = chain.displacements()[0];
          const bool slides = now - before > 1e-4;
          if (slides && rested) starts.push_back(chain.time());
          rested = !slides;
          before = now;
        }
        return starts.size() == 4 ? (starts[3] - starts[1]) / 2.0 : 0.0;
      }));
    EXPECT_GT(periods[0], 100.0);
    EXPECT_NEAR(periods[0] / periods[1], 1.0, 1e-3) << to_string(friction.law);
  }
}

TEST(SliderPhysics, ExtremeParametersStayFinite) {
  struct Case {
    int blocks;
    double kl, velocity, low, high;
  };
  for (const Case &c : {Case{64, 1e-4, 0.01, 0.5, 1.0},
                        {64, 10.0, 0.01, 0.5, 1.0},
                        {64, 0.01, 1e-6, 0.5, 1.0},
                        {64, 10.0, 1.0, 0.5, 1.0},
                        {1, 0.01, 0.01, 0.5, 1.0},
                        {2, 0.01, 0.1, 0.5, 1.0},
                        {64, 0.01, 0.1, 0.7, 0.7},
                        {64, 0.01, 0.1, 0.7, 0.7 + 1e-9}}) {
    Parameters p;
    p.blocks = c.blocks;
    p.kl = c.kl;
    p.velocity = c.velocity;
    p.dt = std::min(stability_limit(p) * 0.999, 1.0);
    Chain chain(p, random_friction(p.blocks, c.low, c.high, 5), false);
    for (int n = 0; n < 50000; ++n) chain.advance();
    const auto u = chain.displacements();
    for (const double x : u) ASSERT_TRUE(std::isfinite(x) && x >= 0.0);
    const double direct = direct_energy(p, u, chain.plate());
    // Rounding errors of displacements are relative to the displacement of the plate, and each acts
    // through a force of order one. In the worst case all have the same sign.
    const double rounding = 2.2e-16 * chain.plate() * p.blocks * 50000.0;
    EXPECT_NEAR(chain.pe(), direct, rounding + 1e-9 * (1.0 + direct));
  }
}

}  // namespace
}  // namespace Slider
