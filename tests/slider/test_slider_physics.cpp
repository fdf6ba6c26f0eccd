// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scalar_chain.h"
#include "slider_chain.h"
#include "switching_chain.h"

namespace Slider {
namespace {

constexpr Scheme stepped[] = {Scheme::printed, Scheme::verlet};

// Displacements at the end of a run with any scheme.
std::vector<double> final_state(Parameters p, const AnyScheme &scheme, double h, double time,
                                const std::vector<double> &mu, const std::vector<double> &start) {
  p.dt = h;
  return with_chain(p, mu, scheme, [&](auto &chain) {
    chain.set_displacements(start);
    for (long n = 0; n < std::lround(time / h); ++n) chain.advance();
    return chain.displacements();
  });
}

double largest_difference(const std::vector<double> &a, const std::vector<double> &b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

// One event from a common state: five blocks are just below their limits, and one is just above.
struct OneEvent {
  Parameters p;
  std::vector<double> mu, start;
  double time = 12.8;
  OneEvent() {
    p.blocks = 12;
    p.kl = 0.1;
    mu = random_friction(p.blocks, 0.5, 1.0, 7);
    // Displacements for which every block but the fourth is 10 % to 45 % below its limit.
    start.assign(12, 0.0);
    for (std::size_t i = 0; i < 12; ++i)
      start[i] = -6.0 + 0.3 * std::sin(2.0 * static_cast<double>(i));
    start[3] = -6.6;
  }
};

TEST(SliderPhysics, FrictionlessBlockFollowsClosedForm) {
  // M U'' = K_l (V t - U) from rest gives U = V t - (V / w) sin w t, which never decreases.
  Parameters p;
  p.blocks = 1;
  p.kl = 0.7;
  p.mass = 1.3;
  p.velocity = 0.2;
  const double w = std::sqrt(p.kl / p.mass), time = 20.0;
  const double exact = p.velocity * time - p.velocity / w * std::sin(w * time);
  const double tolerance[] = {2e-3, 1e-6};
  for (int k = 0; k < 2; ++k)
    EXPECT_NEAR(final_state(p, stepped[k], 0.002, time, {0.0}, {0.0})[0], exact, tolerance[k])
        << to_string(stepped[k]);
  EXPECT_NEAR(final_state(p, Located::rk4, 0.01, time, {0.0}, {0.0})[0], exact, 1e-10);
  EXPECT_NEAR(final_state(p, Located::reference, 0.1, time, {0.0}, {0.0})[0], exact, 1e-12);
}

TEST(SliderPhysics, BlockBetweenStuckNeighboursFollowsClosedForm) {
  // Two springs hold the moving block, whether they lead to one neighbour (N = 2) or two.
  for (int blocks : {2, 3, 5}) {
    Parameters p;
    p.blocks = blocks;
    p.kl = 0.05;
    p.velocity = 0.3;
    std::vector<double> mu(static_cast<std::size_t>(blocks), 1000.0);
    mu[0] = 0.0;
    const std::vector<double> start(mu.size(), 0.0);
    const double k = 2.0 * p.kc + p.kl, w = std::sqrt(k), time = 10.0;
    const double exact = p.kl * p.velocity / k * (time - std::sin(w * time) / w);
    const std::vector<double> u = final_state(p, Scheme::verlet, 0.001, time, mu, start);
    EXPECT_NEAR(u[0], exact, 1e-7);
    for (std::size_t i = 1; i < u.size(); ++i) EXPECT_EQ(u[i], 0.0);
    EXPECT_NEAR(final_state(p, Located::rk4, 0.01, time, mu, start)[0], exact, 1e-10);
  }
}

TEST(SliderPhysics, LoadingAndOnsetOfOneBlock) {
  for (Scheme scheme : stepped) {
    Parameters p;
    p.blocks = 1;
    p.dt = 0.01;
    p.scheme = scheme;
    Chain chain(p, {0.6}, false);
    // K_l V t exceeds mu after t = 6000.
    while (chain.displacements()[0] == 0.0 && chain.time() < 7000.0) {
      chain.advance();
      if (chain.displacements()[0] == 0.0) {
        const double expected = 0.5 * p.kl * chain.plate() * chain.plate();
        ASSERT_NEAR(chain.pe(), expected, 1e-13 * (1.0 + expected));
      }
    }
    EXPECT_NEAR(chain.time(), 6000.0, 3.0 * p.dt) << to_string(scheme);
  }
}

TEST(SliderPhysics, EqualBlocksMoveAsOne) {
  Parameters p;
  p.dt = 0.05;
  p.blocks = 1;
  p.velocity = 0.05;
  Chain one(p, {0.7}, false);
  p.blocks = 37;
  Chain many(p, std::vector<double>(37, 0.7), false);
  for (int n = 0; n < 100000; ++n) {
    one.advance();
    many.advance();
  }
  ASSERT_GT(one.slip_sum(), 100.0);
  for (double u : many.displacements()) EXPECT_EQ(u, one.displacements()[0]);
  EXPECT_NEAR(many.pe(), 37.0 * one.pe(), 1e-10 * many.pe());
}

TEST(SliderPhysics, ConvergenceOrdersOnOneEvent) {
  const OneEvent e;
  const std::vector<double> exact =
      final_state(e.p, Located::reference, 0.1, e.time, e.mu, e.start);
  const double slip = largest_difference(exact, e.start);
  ASSERT_GT(slip, 1.0);  // there is an event
  struct Case {
    AnyScheme scheme;
    double order;
  };
  for (const Case &c : {Case{Scheme::printed, 1.0}, Case{Euler(), 1.0}, Case{Scheme::verlet, 2.0},
                        Case{Located::rk4, 4.0}}) {
    // The order is the slope of log error against log h by least squares.
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    int n = 0;
    double last = 0.0;
    for (double h = 0.1; h > 0.1 / 40.0; h /= 2.0, ++n) {
      last = largest_difference(final_state(e.p, c.scheme, h, e.time, e.mu, e.start), exact) / slip;
      const double x = std::log(h), y = std::log(last);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    const double order = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    RecordProperty(name_of(c.scheme), std::to_string(order));
    EXPECT_NEAR(order, c.order, 0.25) << name_of(c.scheme);
    EXPECT_LT(last, c.order < 1.5 ? 2e-2 : c.order < 3.0 ? 1e-4 : 1e-8) << name_of(c.scheme);
  }
}

TEST(SliderPhysics, ReferenceAgreesWithItselfAtAnotherStep) {
  const OneEvent e;
  const auto a = final_state(e.p, Located::reference, 0.1, e.time, e.mu, e.start);
  const auto b = final_state(e.p, Located::reference, 0.025, e.time, e.mu, e.start);
  EXPECT_LT(largest_difference(a, b), 1e-11);
}

TEST(SliderPhysics, NoBackSlip) {
  Parameters p;
  p.blocks = 40;
  p.velocity = 0.1;
  p.dt = 0.05;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 3);
  for (const AnyScheme scheme :
       {AnyScheme(Scheme::printed), AnyScheme(Scheme::verlet), AnyScheme(Located::rk4)}) {
    with_chain(p, mu, scheme, [&](auto &chain) {
      std::vector<double> before = chain.displacements();
      int stops = 0;
      std::vector<double> v_before = chain.velocities();
      for (int n = 0; n < 30000; ++n) {
        chain.advance();
        const auto u = chain.displacements(), v = chain.velocities();
        for (std::size_t i = 0; i < u.size(); ++i) {
          // Where switches are located, only rounding errors remain.
          ASSERT_GE(u[i], before[i] - 1e-12) << name_of(scheme) << " step " << n;
          ASSERT_GE(v[i], 0.0) << name_of(scheme) << " step " << n;
          stops += v[i] == 0.0 && v_before[i] > 0.0;
        }
        before = u;
        v_before = v;
      }
      EXPECT_GT(stops, 20) << name_of(scheme);
    });
  }
}

TEST(SliderPhysics, BlockPushedBackwardsStaysStuck) {
  Parameters p;
  p.blocks = 3;
  p.dt = 0.01;
  for (Scheme scheme : stepped) {
    p.scheme = scheme;
    // The first block is ahead by 2 and pushed back with a force of 4, less and more than its
    // strength; the others are pulled forward by 2 each.
    for (const double strength : {5.0, 3.0}) {
      StartedChain chain(p, {strength, strength, strength});
      chain.set_displacements({2.0, 0.0, 0.0});
      for (int n = 0; n < 1000; ++n) chain.advance();
      EXPECT_EQ(chain.displacements()[0], 2.0) << strength;
      EXPECT_EQ(chain.moved(), 0) << strength;
    }
  }
}

// One block in the middle of a slip, after one step.
// \param force force of its leaf spring
ChainState after_a_step(Parameters p, double v, double force) {
  p.blocks = 1;
  StartedChain chain(p, {0.8});
  ChainState s = chain.state();
  s.u[0] = -force / p.kl;
  s.v[0] = v;
  chain.set_state(s);
  chain.advance();
  s.v[0] = chain.velocities()[0];
  s.u[0] = chain.displacements()[0] - s.u[0];
  return s;
}

TEST(SliderPhysics, PrintedSchemeStopsABlockWithTheAccelerationThatStopsIt) {
  // Eqs. 7 and 8 with a = f - mu_0 / (1 + v), or a = -v/h where the block would move back.
  Parameters p;
  p.scheme = Scheme::printed;
  p.dt = 0.01;
  const double h = p.dt, v = 0.5, force = 0.2, a = force - 0.8 / (1.0 + v);
  const ChainState moves = after_a_step(p, v, force);
  EXPECT_DOUBLE_EQ(moves.v[0], v + h * a);
  EXPECT_NEAR(moves.u[0], h * v + 0.5 * h * h * a, 1e-14);
  const double slow = 0.001;
  ASSERT_LT(slow + h * (force - 0.8 / (1.0 + slow)), 0.0);
  const ChainState stops = after_a_step(p, slow, force);
  EXPECT_EQ(stops.v[0], 0.0);
  EXPECT_NEAR(stops.u[0], 0.5 * h * slow, 1e-14);
}

TEST(SliderPhysics, EnergyLedgerClosesAsTheSchemeConverges) {
  // Work of the plate = PE + kinetic energy + friction loss.
  const OneEvent e;
  double gap[2] = {};
  for (int k = 0; k < 2; ++k) {
    Parameters p = e.p;
    p.dt = k == 0 ? 0.02 : 0.005;
    ScalarChain chain(p, e.mu, true);
    chain.set_displacements(e.start);
    const double pe_start = chain.pe();
    for (long n = 0; n < std::lround(e.time / p.dt); ++n) chain.advance();
    const EnergyLedger l = chain.ledger();
    ASSERT_GT(l.friction, 0.1);
    gap[k] = std::fabs(l.plate - (chain.pe() - pe_start) - l.kinetic - l.friction) / l.friction;
  }
  EXPECT_GT(std::log(gap[0] / gap[1]) / std::log(4.0), 1.6);
  EXPECT_LT(gap[1], 1e-4);
}

TEST(SliderPhysics, PeriodsOfOneBlockAreThoseOfTheReference) {
  struct Case {
    Friction friction;
    double kl;
  };
  for (const Case &c :
       {Case{{Law::velocity_weakening, 1.0}, 0.05}, Case{{Law::coulomb, 0.75}, 0.05}}) {
    Parameters p;
    p.blocks = 1;
    p.velocity = 0.01;
    p.kl = c.kl;
    p.dt = 0.05;
    p.friction = c.friction;
    std::vector<double> periods;
    for (const AnyScheme scheme : {AnyScheme(Scheme::verlet), AnyScheme(Located::reference)}) {
      // Times at which slip begins after rest.
      const std::vector<double> starts = with_chain(p, {0.8}, scheme, [](auto &chain) {
        std::vector<double> found;
        bool rested = true;
        while (found.size() < 4 && chain.time() < 50000.0) {
          const double before = chain.slip_sum();
          chain.advance();
          const bool slides = chain.slip_sum() - before > 1e-4;
          if (slides && rested) found.push_back(chain.time());
          rested = !slides;
        }
        return found;
      });
      ASSERT_EQ(starts.size(), 4U) << name_of(scheme);
      periods.push_back((starts[3] - starts[1]) / 2.0);
    }
    EXPECT_NEAR(periods[0] / periods[1], 1.0, 1e-3) << to_string(c.friction.law);
  }
}

TEST(SliderPhysics, ExtremeParametersStayFinite) {
  struct Case {
    int blocks;
    double kl, velocity, low, high;
  };
  for (const Case &c : {Case{64, 1e-4, 0.01, 0.5, 1.0}, Case{64, 10.0, 0.01, 0.5, 1.0},
                        Case{64, 0.01, 1e-6, 0.5, 1.0}, Case{64, 0.01, 1.0, 0.5, 1.0},
                        Case{64, 10.0, 1.0, 0.5, 1.0}, Case{1, 0.01, 0.01, 0.5, 1.0},
                        Case{2, 0.01, 0.1, 0.5, 1.0}, Case{3, 0.01, 0.1, 0.5, 1.0},
                        Case{64, 0.01, 0.1, 0.7, 0.7}, Case{64, 0.01, 0.1, 0.7, 0.7 + 1e-9}}) {
    Parameters p;
    p.blocks = c.blocks;
    p.kl = c.kl;
    p.velocity = c.velocity;
    p.dt = std::min(stability_limit(p) * 0.999, 1.0);
    Chain chain(p, random_friction(p.blocks, c.low, c.high, 5), false);
    for (int n = 0; n < 50000; ++n) chain.advance();
    const auto u = chain.displacements();
    for (double x : u) ASSERT_TRUE(std::isfinite(x) && x >= 0.0);
    const double direct = direct_energy(p, u, chain.plate());
    // Rounding errors of displacements are relative to the displacement of the plate, and each acts
    // through a force of order one. In the worst case all have the same sign.
    const double rounding = 2.2e-16 * chain.plate() * p.blocks * 50000.0;
    EXPECT_NEAR(chain.pe(), direct, rounding + 1e-9 * (1.0 + direct));
  }
}

}  // namespace
}  // namespace Slider
