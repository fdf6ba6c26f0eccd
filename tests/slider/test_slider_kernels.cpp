// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

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

// The arithmetic of a block is that of a straightforward loop as well; only PE is summed
// differently.
TEST(SliderKernels, ActiveSetEqualsDenseToTheLastDigit) {
  for (const Case &c : cases) {
    for (Scheme scheme : {Scheme::printed, Scheme::verlet}) {
      const Parameters p = parameters(c, scheme);
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 11);
      Chain active(p, mu, false);
      Chain dense(p, mu, true);
      ScalarChain scalar(p, mu);
      for (int n = 0; n < c.steps; ++n) {
        active.advance();
        dense.advance();
        scalar.advance();
        ASSERT_EQ(active.pe(), dense.pe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.dpe(), dense.dpe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.slip_sum(), dense.slip_sum()) << "N " << c.blocks << " step " << n;
        ASSERT_NEAR(active.pe(), scalar.pe(), 1e-10 * (1.0 + scalar.pe())) << "step " << n;
      }
      EXPECT_EQ(active.displacements(), dense.displacements());
      EXPECT_EQ(active.displacements(), scalar.displacements());
      EXPECT_EQ(active.velocities(), dense.velocities());
      EXPECT_GT(dense.moved(), 100) << "N " << c.blocks << ": nothing was tested";
    }
  }
}

// Block 6 slides and loads block 7, which begins to slide in the step after; that moves block 8,
// the first of a chunk that is idle otherwise.
TEST(SliderKernels, ABlockThatIsAboutToStartWakesItsNeighbour) {
  const Parameters p = parameters({16, 0.01, 1e-3, 0.1, 0}, Scheme::printed);
  std::vector<double> mu(16, 1.0);
  mu[7] = 0.05;
  mu[8] = 1e-4;
  Chain active(p, mu, false), dense(p, mu, true);
  ChainState s = dense.state();
  s.v[6] = 1.0;
  for (Chain *chain : {&active, &dense}) {
    chain->set_state(s);
    for (int n = 0; n < 4; ++n) chain->advance();
  }
  EXPECT_GT(dense.displacements()[8], 0.0);
  EXPECT_EQ(active.displacements(), dense.displacements());
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
