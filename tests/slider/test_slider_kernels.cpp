// SPDX-License-Identifier: GPL-2.0-or-later
// Every way to step beside a plain loop over all blocks; what is skipped, saved or computed with
// other instructions changes no digit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "scalar_chain.h"
#include "slider_chain.h"
#include "slider_ways.h"

namespace Slider {
namespace {

TEST(SliderKernels, EveryWayToStepIsThatOfTheSumOverAllPairs) {
  for (const Way &w : all_ways()) {
    const Parameters p = parameters_of(w, 37);
    const auto mu = random_friction(p.blocks, 0.5, 1.0, 6);
    Chain chain(p, mu, false);
    ScalarChain scalar(p, mu);
    for (int n = 0; n < 2500; ++n) {
      chain.advance();
      scalar.advance();
    }
    const auto a = chain.displacements(), b = scalar.displacements();
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
    EXPECT_LT(worst, w.modes ? 1e-7 : 1e-300) << name(w);
    EXPECT_NEAR(chain.pe(), scalar.pe(), 1e-7 * scalar.pe()) << name(w);
    EXPECT_GT(chain.moved(), 1000) << name(w);
  }
}

TEST(SliderKernels, WaysThatDoNotFitTogetherAreRefused) {
  const auto refused = [](const Parameters &p) {
    EXPECT_THROW(step_function(p, InstructionSet::baseline), std::invalid_argument);
  };
  Parameters p = parameters_of({Scheme::printed, Law::velocity_weakening, 0.0, false}, 8);
  for (const Way &w : {Way{Scheme::printed, Law::velocity_weakening, 0.1, false},
                       {Scheme::printed, Law::coulomb, 0.0, false},
                       {Scheme::printed, Law::velocity_weakening, 0.0, true},
                       {Scheme::adams_bashforth, Law::velocity_weakening, 1.0, true},
                       {Scheme::adams_bashforth, Law::coulomb, 1.0, false}})
    refused(parameters_of(w, 8));
  p.scheme = Scheme::adams_bashforth;
  refused(p);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (!has(set)) {
      EXPECT_THROW(step_function(Parameters(), set), std::invalid_argument);
    }
}

TEST(SliderKernels, ActiveSetEqualsDenseToTheLastDigit) {
  // The arithmetic of a block is that of a plain loop as well; only PE is summed differently. A
  // chain that is set to the saved state every seven steps follows.
  struct Case {
    int blocks;
    double kl, velocity, dt;
    int steps;
  };
  for (const Case &c : {Case{1, 0.01, 0.1, 0.05, 60000},
                        {2, 0.01, 0.1, 0.05, 60000},
                        {7, 0.01, 0.1, 0.05, 60000},
                        {8, 0.01, 0.1, 0.05, 60000},
                        {9, 0.01, 0.1, 0.05, 60000},
                        {17, 0.01, 0.1, 0.05, 60000},
                        {100, 0.01, 0.02, 0.1, 60000},
                        {255, 0.1, 0.01, 0.1, 60000},
                        {64, 5.0, 0.5, 0.1, 20000},
                        {64, 1e-3, 1.0, 0.1, 60000}})
    for (const Scheme scheme : {Scheme::printed, Scheme::verlet}) {
      Parameters p;
      p.blocks = c.blocks;
      p.kl = c.kl;
      p.velocity = c.velocity;
      p.dt = c.dt;
      p.scheme = scheme;
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 11);
      Chain active(p, mu, false), dense(p, mu, true), again(p, mu, false);
      ScalarChain scalar(p, mu);
      for (int n = 0; n < c.steps; ++n) {
        if (n % 7 == 0) again.set_state(active.state());
        for (Chain *chain : {&active, &dense, &again}) chain->advance();
        scalar.advance();
        ASSERT_EQ(active.pe(), dense.pe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.pe(), again.pe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.dpe(), dense.dpe()) << "N " << c.blocks << " step " << n;
        ASSERT_EQ(active.slip_sum(), dense.slip_sum()) << "N " << c.blocks << " step " << n;
        ASSERT_NEAR(active.pe(), scalar.pe(), 1e-10 * (1.0 + scalar.pe())) << "step " << n;
      }
      EXPECT_EQ(active.displacements(), dense.displacements());
      EXPECT_EQ(active.displacements(), scalar.displacements());
      EXPECT_EQ(active.displacements(), again.displacements());
      EXPECT_EQ(active.velocities(), dense.velocities());
      EXPECT_EQ(active.moved(), again.moved());
      EXPECT_GT(dense.moved(), 100) << "N " << c.blocks << ": nothing was tested";
    }
}

// Block 6 slides and loads block 7, which begins to slide in the step after; that moves block 8,
// the first of a chunk that is idle otherwise.
TEST(SliderKernels, ABlockThatIsAboutToStartWakesItsNeighbour) {
  Parameters p;
  p.blocks = 16;
  p.velocity = 1e-3;
  p.dt = 0.1;
  p.scheme = Scheme::printed;
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

TEST(SliderKernels, JumpsSavedStatesAndInstructionSetsChangeNoDigit) {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (has(set)) sets.push_back(set);
  if (sets.empty()) sets.push_back(InstructionSet::baseline);
  for (const Way &w : all_ways())
    for (const double correlation : {0.0, 0.4}) {
      Parameters p = parameters_of(w, 30);
      p.landscape.length = correlation;
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 14);
      Chain dense(p, mu, true, InstructionSet::baseline);
      std::vector<std::unique_ptr<Chain>> jumping;
      for (const InstructionSet set : sets)
        jumping.push_back(std::make_unique<Chain>(p, mu, false, set));
      std::int64_t jumped = 0;
      const std::int64_t end = 30000;
      while (dense.step() < end) {
        const auto to = std::min<std::int64_t>(jumping[0]->quiet_until(), end);
        jumped += std::max<std::int64_t>(0, to - dense.step() - 1);
        while (dense.step() < std::max(to, jumping[0]->step() + 1)) dense.advance();
        for (const auto &chain : jumping) {
          if (to > chain->step() + 1)
            chain->jump(to);
          else
            chain->advance();
          if (chain->step() % 1000 == 7) chain->set_state(chain->state());
          ASSERT_EQ(dense.pe(), chain->pe()) << name(w) << " step " << chain->step();
        }
      }
      for (const auto &chain : jumping) {
        EXPECT_EQ(dense.displacements(), chain->displacements()) << name(w);
        EXPECT_EQ(dense.velocities(), chain->velocities()) << name(w);
      }
      EXPECT_GT(jumped, 100) << name(w);
      EXPECT_GT(dense.moved(), 1000) << name(w);
    }
}

TEST(SliderKernels, StabilityLimitsBoundTheFreeMotion) {
  // Just below the limit of a scheme the shortest wave of blocks that slide without friction
  // remains bounded, and just above it grows. With one block no spring is stretched, and with three
  // the shortest wave has a length of three blocks.
  Parameters few;
  for (const auto &[blocks, limit] : {std::pair(1, 20.0), {3, 2.0 / std::sqrt(3.01)}}) {
    few.blocks = blocks;
    EXPECT_NEAR(stability_limit(few), limit, 1e-12);
  }
  for (const Way &w : all_ways()) {
    if (w.law != Law::coulomb) continue;
    Parameters p = parameters_of(w, 16);
    p.friction = {Law::coulomb, 1.0};
    p.velocity = 1.0;  // keeps all blocks sliding
    const auto grows = [&](double factor) {
      p.dt = factor * stability_limit(p);
      Chain chain(p, std::vector<double>(16, 0.0), false);
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
