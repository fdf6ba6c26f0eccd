// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "scalar_chain.h"
#include "slider_chain.h"

namespace Slider {
namespace {

struct Case {
  int blocks;
  double kl, velocity, dt;
  int steps;
};
constexpr Case cases[] = {
    {1, 0.01, 0.1, 0.05, 60000},  {2, 0.01, 0.1, 0.05, 60000},  {3, 0.01, 0.1, 0.05, 60000},
    {7, 0.01, 0.1, 0.05, 60000},  {8, 0.01, 0.1, 0.05, 60000},  {9, 0.01, 0.1, 0.05, 60000},
    {16, 0.05, 0.1, 0.02, 60000}, {17, 0.01, 0.1, 0.05, 60000}, {100, 0.01, 0.02, 0.1, 60000},
    {255, 0.1, 0.01, 0.1, 60000}, {64, 5.0, 0.5, 0.1, 20000},   {64, 1e-3, 1.0, 0.1, 60000}};

Parameters parameters(const Case &c, Scheme scheme) {
  Parameters p;
  p.blocks = c.blocks;
  p.kl = c.kl;
  p.velocity = c.velocity;
  p.dt = c.dt;
  p.scheme = scheme;
  return p;
}

TEST(SliderKernels, CoulombFrictionAgreesOverKernelsAndInstructionSets) {
  for (const Case &c : {cases[0], cases[3], cases[7], cases[8], cases[10]}) {
    Parameters p;
    p.blocks = c.blocks;
    p.kl = c.kl;
    p.dt = c.dt;
    p.velocity = std::max(c.velocity, 0.1);
    p.friction = {Law::coulomb, 0.7};
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 11);
    Chain active(p, mu, false);
    Chain dense(p, mu, true, InstructionSet::baseline);
    ScalarChain scalar(p, mu);
    for (int n = 0; n < 20000; ++n) {
      active.advance();
      dense.advance();
      scalar.advance();
      ASSERT_EQ(active.pe(), dense.pe()) << "N " << c.blocks << " step " << n;
      ASSERT_EQ(active.slip_sum(), dense.slip_sum()) << "N " << c.blocks;
      if (n == 10000) active.set_state(active.state());  // holds all that is needed
    }
    EXPECT_EQ(active.displacements(), scalar.displacements()) << "N " << c.blocks;
    EXPECT_EQ(active.velocities(), scalar.velocities()) << "N " << c.blocks;
    EXPECT_NEAR(active.pe(), scalar.pe(), 1e-9 * scalar.pe());
    EXPECT_GT(dense.moved(), 100) << "N " << c.blocks << ": nothing was tested";
  }
}

TEST(SliderKernels, ASchemeThatDoesNotFitTheModelIsRefused) {
  const auto refuses = [](const Parameters &p) {
    EXPECT_THROW(step_function(p, InstructionSet::baseline), std::invalid_argument);
  };
  Parameters p;
  p.scheme = Scheme::adams_bashforth;
  refuses(p);  // nothing balances the springs
  p.scheme = Scheme::printed;
  EXPECT_NE(step_function(p, InstructionSet::baseline), nullptr);
  p.radiation = 0.1;
  refuses(p);
  p.radiation = 0.0;
  p.friction.law = Law::coulomb;
  refuses(p);
}

TEST(SliderKernels, ActiveSetEqualsDenseToTheLastDigit) {
  for (const Case &c : cases) {
    for (Scheme scheme : {Scheme::printed, Scheme::verlet}) {
      const Parameters p = parameters(c, scheme);
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 11);
      Chain active(p, mu, false);
      Chain dense(p, mu, true);
      for (int n = 0; n < c.steps; ++n) {
        active.advance();
        dense.advance();
        ASSERT_EQ(active.pe(), dense.pe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.dpe(), dense.dpe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.slip_sum(), dense.slip_sum()) << "N " << c.blocks << " step " << n;
      }
      EXPECT_EQ(active.displacements(), dense.displacements());
      EXPECT_EQ(active.velocities(), dense.velocities());
      EXPECT_GT(dense.moved(), 100) << "N " << c.blocks << ": nothing was tested";
    }
  }
}

TEST(SliderKernels, InstructionSetsAgreeToTheLastDigit) {
  for (InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has(set)) {
      EXPECT_THROW(step_function(Parameters(), set), std::invalid_argument);
      continue;
    }
    for (const Case &c : cases) {
      for (Scheme scheme : {Scheme::printed, Scheme::verlet}) {
        const Parameters p = parameters(c, scheme);
        const auto mu = random_friction(p.blocks, 0.5, 1.0, 12);
        Chain one(p, mu, false, InstructionSet::baseline);
        Chain other(p, mu, false, set);
        for (int n = 0; n < 20000; ++n) {
          one.advance();
          other.advance();
        }
        EXPECT_EQ(one.pe(), other.pe()) << to_string(set);
        EXPECT_EQ(one.displacements(), other.displacements()) << to_string(set);
      }
    }
  }
}

TEST(SliderKernels, AgreesWithStraightforwardLoop) {
  // The arithmetic of a block is the same, and so is the motion; only PE is summed differently.
  for (const Case &c : cases) {
    for (Scheme scheme : {Scheme::printed, Scheme::verlet}) {
      const Parameters p = parameters(c, scheme);
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 13);
      Chain active(p, mu, false);
      ScalarChain scalar(p, mu);
      for (int n = 0; n < 20000; ++n) {
        active.advance();
        scalar.advance();
        ASSERT_NEAR(active.pe(), scalar.pe(), 1e-10 * (1.0 + scalar.pe())) << "step " << n;
      }
      EXPECT_EQ(active.displacements(), scalar.displacements());
    }
  }
}

TEST(SliderKernels, QuietStretchesCanBeJumped) {
  Parameters p;
  p.blocks = 30;
  p.dt = 0.05;
  p.velocity = 0.1;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 14);
  Chain walks(p, mu, false);
  Chain jumps(p, mu, false);
  long long jumped = 0;
  const long long end = 200000;
  while (jumps.step() < end) {
    const auto to = std::min<std::int64_t>(jumps.quiet_until(), end);
    if (to > jumps.step() + 1) {
      jumped += to - jumps.step();
      jumps.jump(to);
    } else {
      jumps.advance();
    }
    while (walks.step() < jumps.step()) walks.advance();
    ASSERT_EQ(walks.pe(), jumps.pe()) << jumps.step();
    ASSERT_EQ(walks.dpe(), jumps.dpe()) << jumps.step();
  }
  EXPECT_EQ(walks.displacements(), jumps.displacements());
  EXPECT_GT(jumped, 1000);
  EXPECT_GT(walks.moved(), 1000);
}

TEST(SliderKernels, GoesOnFromAnySavedState) {
  Parameters p;
  p.blocks = 50;
  p.dt = 0.05;
  p.velocity = 0.1;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 15);
  Chain straight(p, mu, false);
  Chain *again = nullptr;
  std::unique_ptr<Chain> holder;
  for (int n = 0; n < 60000; ++n) {
    if (n % 1777 == 0) {
      holder = std::make_unique<Chain>(p, mu, false);
      again = holder.get();
      again->set_state(straight.state());
    }
    straight.advance();
    again->advance();
    ASSERT_EQ(straight.pe(), again->pe()) << n;
    ASSERT_EQ(straight.moved(), again->moved()) << n;
  }
  EXPECT_EQ(straight.displacements(), again->displacements());
}

TEST(SliderKernels, WorkFormulaMatchesSpringEnergies) {
  Parameters p;
  p.blocks = 200;
  p.dt = 0.05;
  const auto mu = random_friction(p.blocks, 0.5, 1.0, 16);
  Chain chain(p, mu, false);
  for (int n = 0; n < 400000; ++n) {
    chain.advance();
    if (n % 5000 == 0) {
      const double direct = direct_energy(p, chain.displacements(), chain.plate());
      ASSERT_NEAR(chain.pe(), direct, 1e-11 * (1.0 + direct)) << n;
    }
  }
  EXPECT_GT(chain.moved(), 1000);
}

}  // namespace
}  // namespace Slider
