// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks coupled by a stiffness per mode, radiation, no inertia, and strengths that vary with
// displacement.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "read_catalogue.h"
#include "scalar_chain.h"
#include "slider_chain.h"
#include "slider_files.h"
#include "slider_run.h"
#include "slider_stiffness.h"
#include "switching_chain.h"

namespace Slider {
namespace {

constexpr Coupling strips[] = {Coupling::antiplane, Coupling::inplane};

Parameters coupled(Coupling coupling, int blocks, double kl = 0.01) {
  Parameters p;
  p.blocks = blocks;
  p.kl = kl;
  p.modes = modes_of(coupling, strip_of_leaf_spring(coupling, p.kc, kl), blocks);
  return p;
}

// Solves y' = f(x, y) over a length by the Runge-Kutta method.
template <std::size_t n, class Derivative>
std::array<double, n> integrate(std::array<double, n> y, double length, const Derivative &f) {
  constexpr int steps = 4000;
  const double h = length / steps;
  const auto plus = [](std::array<double, n> a, double s, const std::array<double, n> &b) {
    for (std::size_t i = 0; i < n; ++i) a[i] += s * b[i];
    return a;
  };
  for (int k = 0; k < steps; ++k) {
    const auto a = f(y), b = f(plus(y, h / 2, a)), c = f(plus(y, h / 2, b)), d = f(plus(y, h, c));
    for (std::size_t i = 0; i < n; ++i) y[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
  }
  return y;
}

// K(q) of two blocks with Lame constants 1 and 1, by integrating the equations of elasticity from
// the plate to the fault.
double antiplane_by_shooting(double q, double width) {
  // u'' = q^2 u
  using State = std::array<double, 2>;
  const State end = integrate(State{0.0, 1.0}, width, [q](const State &y) {
    return State{y[1], q * q * y[0]};
  });
  return 0.5 * end[1] / end[0];
}

double inplane_by_shooting(double q, double width) {
  // u_x = U cos q x, u_y = V sin q x; the state is U, V, U', V', integrated away from the plate.
  using State = std::array<double, 4>;
  const auto navier = [q](const State &y) {
    const double u = 3.0 * q * q * y[0] - 2.0 * q * y[3];
    const double v = (q * q * y[1] + 2.0 * q * y[2]) / 3.0;
    return State{y[2], y[3], u, v};
  };
  const State a = integrate(State{0.0, 0.0, 1.0, 0.0}, width, navier);
  const State b = integrate(State{0.0, 0.0, 0.0, 1.0}, width, navier);
  const auto normal = [q](const State &y) { return 3.0 * y[3] - q * y[0]; };
  const double mixed = -normal(a) / normal(b);
  const auto both = [&](std::size_t i) { return a[i] + mixed * b[i]; };
  return 0.5 * (both(2) + q * both(1)) / both(0);
}

TEST(SliderStiffness, ClosedFormsSolveTheEquationsOfElasticity) {
  for (const double width : {1.0, 5.0, 20.0})
    for (const double q : {0.01, 0.1, 0.3, 0.7}) {
      EXPECT_NEAR(
          0.5 * strip_stiffness(Coupling::antiplane, q, width) / antiplane_by_shooting(q, width),
          1.0, 1e-8)
          << q << " " << width;
      EXPECT_NEAR(
          0.5 * strip_stiffness(Coupling::inplane, q, width) / inplane_by_shooting(q, width), 1.0,
          1e-6)
          << q << " " << width;
    }
}

TEST(SliderStiffness, LimitsOfThinAndThickBlocks) {
  for (const Coupling coupling : strips) {
    for (const double q : {0.0, 1e-9, 1e-7, 1e-5})
      EXPECT_NEAR(strip_stiffness(coupling, q, 7.0), 1.0 / 7.0, 1e-5) << q;
    const double half_space = coupling == Coupling::inplane ? 1.0 / (1.0 - poisson) : 1.0;
    for (const double q : {0.1, 1.0, 3.0})
      EXPECT_NEAR(strip_stiffness(coupling, q, 1e4), half_space * q, 1e-12) << q;
  }
}

TEST(SliderStiffness, ABlockAloneFeelsWhatItFeelsInTheChain) {
  for (const Coupling coupling : strips)
    for (const double kl : {0.01, 0.1, 1.0}) {
      const Strip strip = strip_of_leaf_spring(coupling, 1.0, kl);
      EXPECT_NEAR(strip.modulus / strip.width, kl, 1e-12);
      const Strip again = strip_of_width(coupling, 1.0, strip.width);
      EXPECT_NEAR(again.modulus, strip.modulus, 1e-9);
      const int n = 2000;
      const std::vector<double> modes = modes_of(coupling, strip, n);
      double alone = modes.front() + modes.back();
      for (std::size_t k = 1; k + 1 < modes.size(); ++k) alone += 2.0 * modes[k];
      EXPECT_NEAR(alone / n, 2.0 + kl, 1e-5) << to_string(coupling) << " " << kl;
    }
  EXPECT_NEAR(strip_of_leaf_spring(Coupling::antiplane, 1.0, 0.01).modulus, 2.01 * 2.0 / LSM::pi,
              1e-4);
}

TEST(SliderModes, ForcesAreThoseOfTheSumOverAllPairs) {
  for (const int n : {1, 2, 3, 5, 7, 64, 101, 512, 1009}) {
    const Parameters p = coupled(Coupling::inplane, n);
    const std::vector<double> c = coupling_of(p);
    LSM::Random random(3);
    std::vector<double> u(static_cast<std::size_t>(n));
    for (double &x : u) x = 1000.0 + random.uniform(-10.0, 10.0);
    ModeForces forces(p.modes, n);
    const double *const force = forces.find(u.data());
    for (std::size_t i = 0; i < u.size(); ++i)
      ASSERT_NEAR(force[i], coupling_force(p, c, u.data(), i), 1e-11) << n << " " << i;
  }
}

TEST(SliderModes, StiffnessOfSpringsGivesTheChain) {
  Parameters springs;
  springs.blocks = 60;
  springs.kl = 0.1;
  springs.velocity = 0.1;
  Parameters modes = springs;
  for (int n = 0; n <= 30; ++n)
    modes.modes.push_back(stiffness_of_springs(springs, 2.0 * LSM::pi * n / 60));
  const auto mu = random_friction(60, 0.5, 1.0, 4);
  Chain chain(springs, mu, false), bulk(modes, mu, false);
  // It takes some 300 time units for chaos to amplify a difference in the last digit.
  for (int n = 0; n < 3000; ++n) {
    chain.advance();
    bulk.advance();
  }
  EXPECT_GT(chain.moved(), 1000);
  const auto a = chain.displacements(), b = bulk.displacements();
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-7);
  EXPECT_NEAR(chain.pe(), bulk.pe(), 1e-7 * chain.pe());
}

// Every combination of scheme, law, radiation and coupling that a run can ask for.
struct Way {
  Scheme scheme;
  Law law;
  double radiation;
  bool modes;
};
std::vector<Way> all_ways() {
  std::vector<Way> ways = {{Scheme::printed, Law::velocity_weakening, 0.0, false}};
  for (const Law law : {Law::velocity_weakening, Law::coulomb})
    for (const bool modes : {false, true}) {
      for (const double radiation : {0.0, 0.3})
        ways.push_back({Scheme::verlet, law, radiation, modes});
      ways.push_back({Scheme::adams_bashforth, law, 1.5, modes});
    }
  return ways;
}
std::string name(const Way &w) {
  return std::string(to_string(w.scheme)) + " " + to_string(w.law) + " " +
         std::to_string(w.radiation) + (w.modes ? " modes" : " springs");
}
Parameters parameters_of(const Way &w, int blocks) {
  Parameters p = w.modes ? coupled(Coupling::antiplane, blocks, 0.1) : Parameters();
  p.blocks = blocks;
  p.kl = 0.1;
  p.velocity = 0.1;
  p.scheme = w.scheme;
  p.friction = {w.law, 0.7};
  p.radiation = w.radiation;
  if (w.scheme == Scheme::adams_bashforth) p.mass = 0.0;
  return p;
}

TEST(SliderModes, EveryWayToStepIsThatOfTheSumOverAllPairs) {
  for (const Way &w : all_ways()) {
    const Parameters p = parameters_of(w, 37);
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 6);
    Chain chain(p, mu, false);
    ScalarChain scalar(p, mu, true);
    double worst = 0.0;
    for (int n = 0; n < 2500; ++n) {
      chain.advance();
      scalar.advance();
    }
    const auto a = chain.displacements(), b = scalar.displacements();
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
    EXPECT_LT(worst, w.modes ? 1e-7 : 1e-300) << name(w);
    EXPECT_NEAR(chain.pe(), scalar.pe(), 1e-7 * scalar.pe()) << name(w);
    EXPECT_NEAR(chain.radiated(), scalar.ledger().radiated, 1e-7 * (1.0 + chain.radiated()))
        << name(w);
    EXPECT_EQ(chain.radiated() > 0.0, w.radiation > 0.0) << name(w);
    EXPECT_GT(chain.moved(), 1000) << name(w);
  }
}

TEST(SliderModes, ActiveSetJumpsAndSavedStatesChangeNoDigit) {
  for (const Way &w : all_ways())
    for (const double correlation : {0.0, 0.4}) {
      Parameters p = parameters_of(w, 30);
      p.landscape.length = correlation;
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 14);
      Chain dense(p, mu, true, InstructionSet::baseline), jumps(p, mu, false);
      std::int64_t jumped = 0;
      const std::int64_t end = 30000;
      while (jumps.step() < end) {
        const auto to = std::min<std::int64_t>(jumps.quiet_until(), end);
        if (to > jumps.step() + 1) {
          jumped += to - jumps.step();
          jumps.jump(to);
        } else {
          jumps.advance();
        }
        if (jumps.step() % 1000 == 7) jumps.set_state(jumps.state());
        while (dense.step() < jumps.step()) dense.advance();
        ASSERT_EQ(dense.pe(), jumps.pe()) << name(w) << " step " << jumps.step();
      }
      EXPECT_EQ(dense.displacements(), jumps.displacements()) << name(w);
      EXPECT_EQ(dense.velocities(), jumps.velocities()) << name(w);
      EXPECT_EQ(dense.radiated(), jumps.radiated()) << name(w);
      EXPECT_GT(jumped, 100) << name(w);
      EXPECT_GT(dense.moved(), 1000) << name(w);
    }
}

TEST(SliderModes, ASlipThatReachesRestingBlocksStartsThemAsIfAllWereStepped) {
  // How far a block without inertia slips in its first step depends on the force before it, which
  // nobody has computed while its chunk was idle.
  for (const Law law : {Law::coulomb, Law::velocity_weakening}) {
    Parameters p;
    p.blocks = 400;
    p.scheme = Scheme::adams_bashforth;
    p.mass = 0.0;
    p.radiation = 1.28;
    p.dt = 0.2;
    p.velocity = 0.002;
    p.kl = 0.3;
    p.friction = {law, 0.8};
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 1);
    Chain dense(p, mu, true), active(p, mu, false);
    for (int n = 0; n < 15000; ++n) {
      dense.advance();
      active.advance();
      ASSERT_EQ(dense.pe(), active.pe()) << to_string(law) << " step " << n;
    }
    EXPECT_EQ(dense.displacements(), active.displacements()) << to_string(law);
    EXPECT_GT(active.moved(), 1000) << to_string(law);
  }
}

// Displacements after one event that begins with one block above its limit and the others just
// below theirs.
std::vector<double> after_event(Parameters p, double h, const AnyScheme &scheme, double time,
                                const std::vector<double> &start) {
  p.dt = h;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 7);
  return with_chain(p, mu, scheme, [&](auto &chain) {
    chain.set_displacements(start);
    for (long n = 0; n < std::lround(time / h); ++n) chain.advance();
    return chain.displacements();
  });
}
double order_of(const Parameters &p, Scheme scheme, const std::vector<double> &start,
                const std::vector<double> &exact, double time, double first) {
  std::vector<double> errors;
  for (int k = 0; k < 6; ++k) {
    const auto u = after_event(p, first / (1 << k), scheme, time, start);
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::fabs(u[i] - exact[i]));
    errors.push_back(worst);
  }
  EXPECT_LT(errors.back(), 1e-3);
  return std::log2(errors.front() / errors.back()) / 5.0;
}
std::vector<double> event_start(int blocks) {
  std::vector<double> start;
  for (int i = 0; i < blocks; ++i) start.push_back(-6.0 + 0.3 * std::sin(2.0 * i));
  start[3] = -6.6;
  return start;
}

TEST(SliderModes, VerletIsOfOrderTwoWithModesAndRadiation) {
  for (const double radiation : {0.0, 0.3}) {
    Parameters p = coupled(Coupling::antiplane, 12, 0.1);
    p.radiation = radiation;
    const auto start = event_start(12);
    const auto exact = after_event(p, 0.1, Located::reference, 12.8, start);
    double slip = 0.0;
    for (std::size_t i = 0; i < 12; ++i) slip = std::max(slip, exact[i] - start[i]);
    ASSERT_GT(slip, 1.0);
    EXPECT_NEAR(order_of(p, Scheme::verlet, start, exact, 12.8, 0.1), 2.0, 0.25) << radiation;
  }
}

// Without inertia velocities jump when blocks start and, with velocity weakening, when they stop.
TEST(SliderModes, WithoutInertiaTheOrderIsTwoAcrossStartsAndStops) {
  struct Case {
    Friction friction;
    double radiation;
  };
  for (const Case &c : {Case{{Law::velocity_weakening, 1.0}, 0.6},
                        {{Law::velocity_weakening, 1.0}, 1.5},
                        {{Law::coulomb, 0.6}, 0.6},
                        {{Law::coulomb, 1.0}, 0.6}}) {
    Parameters p = coupled(Coupling::antiplane, 12, 0.1);
    p.friction = c.friction;
    p.radiation = c.radiation;
    p.mass = 0.0;
    const auto start = event_start(12);
    const std::string what = std::string(to_string(c.friction.law)) + " " +
                             std::to_string(c.friction.dynamic) + " " + std::to_string(c.radiation);
    const auto fine = after_event(p, 0.05 / 1024, Scheme::adams_bashforth, 3.2, start);
    int slid = 0;
    for (std::size_t i = 0; i < 12; ++i) slid += fine[i] > start[i] + 0.1;
    EXPECT_GT(slid, 0) << what;
    EXPECT_GT(order_of(p, Scheme::adams_bashforth, start, fine, 3.2, 0.05), 1.75) << what;
  }
}

TEST(SliderModes, LightBlocksApproachThoseWithoutInertia) {
  Parameters p = coupled(Coupling::antiplane, 12, 0.1);
  p.radiation = 2.0;
  std::vector<double> start(12, -9.0);
  for (std::size_t i = 0; i < 12; ++i) start[i] += 0.3 * std::sin(2.0 * static_cast<double>(i));
  Parameters none = p;
  none.mass = 0.0;
  none.scheme = Scheme::adams_bashforth;
  const auto limit = after_event(none, 0.002, Scheme::adams_bashforth, 6.4, start);
  double before = 1e300;
  for (const double mass : {0.1, 0.03, 0.01}) {
    p.mass = mass;
    const auto u = after_event(p, 0.002, Scheme::verlet, 6.4, start);
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) worst = std::max(worst, std::fabs(u[i] - limit[i]));
    EXPECT_LT(worst, 0.5 * before) << mass;
    before = worst;
  }
  EXPECT_LT(before, 0.02);
}

TEST(SliderModes, EnergyLedgerClosesWithRadiation) {
  for (const double mass : {1.0, 0.0}) {
    Parameters p = coupled(Coupling::inplane, 12, 0.1);
    p.radiation = 0.3;
    if (mass == 0.0) {
      p.mass = 0.0;
      p.scheme = Scheme::adams_bashforth;
      p.friction = {Law::coulomb, 0.6};
    }
    const std::vector<double> start = event_start(12);
    double gap[2] = {};
    for (int k = 0; k < 2; ++k) {
      p.dt = k == 0 ? 0.02 : 0.005;
      ScalarChain scalar(p, random_friction(12, 0.5, 1.0, 7), true);
      StartedChain chain(p, random_friction(12, 0.5, 1.0, 7));
      scalar.set_displacements(start);
      chain.set_displacements(start);
      const double pe_start = scalar.pe();
      for (long n = 0; n < std::lround(12.8 / p.dt); ++n) {
        scalar.advance();
        chain.advance();
      }
      const EnergyLedger l = scalar.ledger();
      ASSERT_GT(l.friction, 0.1);
      ASSERT_GT(l.radiated, 0.01);
      EXPECT_NEAR(chain.radiated(), l.radiated, 1e-9);
      EXPECT_NEAR(chain.kinetic(), l.kinetic, 1e-9);
      gap[k] = std::fabs(l.plate - (scalar.pe() - pe_start) - l.kinetic - l.friction - l.radiated) /
               l.friction;
    }
    EXPECT_GT(std::log(gap[0] / gap[1]) / std::log(4.0), 1.5) << mass;
    EXPECT_LT(gap[1], 1e-4) << mass;
  }
}

TEST(SliderModes, StrengthsAreDrawnAnewAlongTheWay) {
  Parameters p;
  p.blocks = 1;
  p.kl = 1.0;
  p.velocity = 0.01;
  p.friction = {Law::coulomb, 1.0};
  p.landscape = {0.25, 0.6, 0.9, 5};
  Chain chain(p, {0.75}, false);
  // The strength is the force of the leaf spring at which the block starts.
  std::vector<double> strengths;
  bool rested = true;
  for (int n = 0; n < 400000; ++n) {
    const double before = chain.slip_sum(), force = p.kl * (chain.plate() - before);
    chain.advance();
    const bool slides = chain.slip_sum() > before;
    if (slides && rested) strengths.push_back(force);
    rested = !slides;
  }
  ASSERT_GT(strengths.size(), 100U);
  const auto [low, high] = std::minmax_element(strengths.begin(), strengths.end());
  EXPECT_GT(*low, 0.59);
  EXPECT_LT(*high, 0.91);
  EXPECT_GT(*high - *low, 0.25);
  EXPECT_GT(chain.slip_sum(), 100.0);
}

RunOptions run_options(const std::string &catalogue) {
  RunOptions o;
  o.parameters = coupled(Coupling::antiplane, 48, 0.05);
  o.parameters.radiation = 0.1;
  o.parameters.landscape.length = 3.0;
  o.mu = random_friction(48, 0.5, 1.0, 21);
  o.steps = 400000;
  o.picker.lambda = 0.95;
  o.overwrite = true;
  o.catalogue = catalogue;
  o.checkpoint = catalogue + ".chk";
  return o;
}

TEST(SliderModes, RunsJumpAndResumeToTheLastByte) {
  for (const Events events : {Events::pe, Events::ruptures}) {
    RunOptions o = run_options(testing::TempDir() + "slider_modes_a.csv");
    o.events = events;
    if (events == Events::ruptures) o.header = {{"events", "ruptures"}};
    const RunResult active = run(o);
    EXPECT_GT(active.events, 20);
    EXPECT_GT(active.jumped, 1000);
    EXPECT_NEAR(active.pe, active.pe_direct, 1e-9 * active.pe);
    const std::string whole = text(o.catalogue), state = text(o.checkpoint);
    o.catalogue = testing::TempDir() + "slider_modes_b.csv";
    o.checkpoint = o.catalogue + ".chk";
    o.dense = true;
    run(o);
    EXPECT_EQ(text(o.catalogue), whole);
    EXPECT_EQ(text(o.checkpoint), state);
    for (o.steps = 123457; o.steps <= 400000; o.steps += 276543) {
      o.resume = o.steps > 123457;
      run(o);
    }
    EXPECT_EQ(text(o.catalogue), whole);
    EXPECT_EQ(text(o.checkpoint), state);
  }
}

TEST(SliderModes, StabilityLimitsBoundTheFreeMotion) {
  // Just below the limit of a scheme the shortest wave of blocks that slide without friction
  // remains bounded, and just above it grows.
  for (const Way &w : all_ways()) {
    if (w.law != Law::coulomb) continue;
    Parameters p = parameters_of(w, 16);
    p.friction = {Law::coulomb, 1.0};
    p.velocity = 1.0;  // keeps all blocks sliding
    const auto grows = [&](double factor) {
      p.dt = factor * stability_limit(p);
      StartedChain chain(p, std::vector<double>(16, 0.0));
      ChainState s = chain.state();
      for (std::size_t i = 0; i < 16; ++i) {
        s.u[i] = i % 2 == 0 ? 1e-4 : -1e-4;
        s.v[i] = 1.0;
      }
      chain.set_state(s);
      double most = 0.0;
      for (int n = 0; n < 400; ++n) {
        chain.advance();
        const auto u = chain.displacements();
        for (std::size_t i = 1; i < 16; ++i) most = std::max(most, std::fabs(u[i] - u[i - 1]));
      }
      return most > 0.01;
    };
    EXPECT_FALSE(grows(0.97)) << name(w);
    EXPECT_TRUE(grows(1.05)) << name(w);
  }
}

}  // namespace
}  // namespace Slider
