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

TEST(SliderKernels, GoesOnFromAnySavedState) {
  for (const Scheme scheme : {Scheme::printed, Scheme::verlet}) {
    Parameters p = parameters({50, 0.01, 0.5, 0.01, 0}, scheme);
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 15);
    Chain straight(p, mu, false);
    std::unique_ptr<Chain> again;
    for (int n = 0; n < 60000; ++n) {
      if (n % 7 == 0) {
        again = std::make_unique<Chain>(p, mu, false);
        again->set_state(straight.state());
      }
      const auto moved = straight.moved() - again->moved();
      straight.advance();
      again->advance();
      ASSERT_EQ(straight.pe(), again->pe()) << n;
      ASSERT_EQ(straight.moved() - again->moved(), moved) << n;
    }
    EXPECT_EQ(straight.displacements(), again->displacements());
    EXPECT_GT(straight.moved(), 1000);
  }
}

}  // namespace
}  // namespace Slider
