// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <queue>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "numerics/random.h"
#include "read_catalogue.h"
#include "slider_chain.h"
#include "slider_ruptures.h"
#include "slider_run.h"
#include "slider_ways.h"

namespace Slider {
namespace {

/// One line per step, one character per block; '#' slides. Each slide has a slip of 1 and a work of
/// 1, and PE after step n is -n.
using Pattern = std::vector<std::string>;

struct Found {
  std::vector<Rupture> ruptures;
  RuptureTracker tracker;
};

/// Finds the ruptures of a pattern.
/// \param restarts whether to restore the tracker from its state after each step
Found track(const Pattern &pattern, std::int64_t memory, bool restarts = false) {
  const int blocks = static_cast<int>(pattern.front().size());
  Found found{{}, RuptureTracker(blocks, memory, true)};
  const auto keep = [&found](const Rupture &r) { found.ruptures.push_back(r); };
  std::int64_t step = 0;
  const auto one = [&](const std::string &line) {
    ++step;
    found.tracker.begin_step(step, -static_cast<double>(step - 1));
    for (int i = 0; i < blocks; ++i)
      if (line[static_cast<std::size_t>(i)] == '#') found.tracker.slide(i, 1.0, 1.0);
    found.tracker.end_step(-static_cast<double>(step), keep);
    if (!restarts) return;
    const RuptureState state = found.tracker.state();
    found.tracker = RuptureTracker(blocks, memory, true);
    found.tracker.set_state(state, step);
  };
  for (const std::string &line : pattern) one(line);
  for (std::int64_t n = 0; n < memory; ++n) one(std::string(pattern.front().size(), '.'));
  EXPECT_TRUE(found.tracker.idle());
  return found;
}

TEST(Ruptures, TwoApart) {
  const Found f = track({".#....#.",  //
                         ".##...#.",  //
                         "..#....."},
                        1);
  ASSERT_EQ(f.ruptures.size(), 2U);
  const Rupture &first = f.ruptures[0], &second = f.ruptures[1];
  EXPECT_EQ(first.step_start, 0);
  EXPECT_EQ(first.step_end, 2);
  EXPECT_EQ(first.begin, 6);
  EXPECT_EQ(first.length, 1);
  EXPECT_EQ(first.size, 2.0);
  EXPECT_EQ(second.step_end, 3);
  EXPECT_EQ(second.begin, 1);
  EXPECT_EQ(second.length, 2);
  EXPECT_EQ(second.slip, 4.0);
  EXPECT_EQ(second.pe_start, 0.0);
  EXPECT_EQ(second.pe_end, -3.0);
  const LSM::Rupture e = f.tracker.event(first, 0.25);
  EXPECT_EQ(e.t_start, 0.0);
  EXPECT_EQ(e.t_end, 0.5);
  EXPECT_EQ(e.size, 2.0);
  EXPECT_EQ(e.slip_moment, 2.0);
  EXPECT_EQ(e.rupture_length, 1.0);
  EXPECT_NEAR(e.x_centroid, 6.0, 1e-14);
}

TEST(Ruptures, AcrossTheSeam) {
  const Found f = track({"#.....",  //
                         "#....#",  //
                         "....##"},
                        1);
  ASSERT_EQ(f.ruptures.size(), 1U);
  EXPECT_EQ(f.ruptures[0].begin, 4);
  EXPECT_EQ(f.ruptures[0].length, 3);
  EXPECT_NEAR(f.tracker.event(f.ruptures[0], 1.0).x_centroid, 5.2, 0.05);
  // Slips 2, 2, 1 on blocks 0, 5, 4 lie about 5.2 on the ring, not about 2.8.
}

/// Finds ruptures by a search through all of space and time.
std::vector<Rupture> search(const Pattern &pattern, std::int64_t memory) {
  const int blocks = static_cast<int>(pattern.front().size()),
            steps = static_cast<int>(pattern.size());
  std::set<std::pair<int, int>> left;  // step, block
  for (int n = 0; n < steps; ++n)
    for (int i = 0; i < blocks; ++i)
      if (pattern[static_cast<std::size_t>(n)][static_cast<std::size_t>(i)] == '#')
        left.emplace(n + 1, i);
  std::vector<Rupture> out;
  while (!left.empty()) {
    std::queue<std::pair<int, int>> todo;
    todo.push(*left.begin());
    Rupture r;
    r.step_start = left.begin()->first - 1;
    r.first = left.begin()->second;
    left.erase(left.begin());
    std::set<int> distinct;
    while (!todo.empty()) {
      const auto [n, i] = todo.front();
      todo.pop();
      r.size += 1.0;
      r.step_end = std::max<std::int64_t>(r.step_end, n);
      distinct.insert(i);
      for (int m = n - static_cast<int>(memory); m <= n + static_cast<int>(memory); ++m)
        for (int d : {-1, 0, 1}) {
          const auto there = left.find({m, (i + d + blocks) % blocks});
          if (there == left.end()) continue;
          todo.push(*there);
          left.erase(there);
        }
    }
    r.length = static_cast<std::int64_t>(distinct.size());
    out.push_back(r);
  }
  std::sort(out.begin(), out.end(), [](const Rupture &a, const Rupture &b) {
    return std::tie(a.step_end, a.step_start, a.first) <
           std::tie(b.step_end, b.step_start, b.first);
  });
  return out;
}

TEST(Ruptures, RandomPatternsAgreeWithASearch) {
  LSM::Random random(5);
  std::size_t several = 0;
  for (const int blocks : {1, 2, 3, 5, 8, 21, 40})
    for (const double density : {0.02, 0.1, 0.2, 0.35, 0.6})
      for (const std::int64_t memory : {1, 2, 4})
        for (int trial = 0; trial < 8; ++trial) {
          Pattern pattern(60, std::string(static_cast<std::size_t>(blocks), '.'));
          for (std::string &line : pattern)
            for (char &c : line)
              if (random.uniform() < density) c = '#';
          const std::vector<Rupture> expected = search(pattern, memory);
          if (expected.size() > 2) ++several;
          for (const bool restarts : {false, true}) {
            const std::vector<Rupture> found = track(pattern, memory, restarts).ruptures;
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t k = 0; k < found.size(); ++k) {
              ASSERT_EQ(found[k].step_start, expected[k].step_start);
              ASSERT_EQ(found[k].step_end, expected[k].step_end);
              ASSERT_EQ(found[k].first, expected[k].first);
              ASSERT_EQ(found[k].length, expected[k].length);
              ASSERT_EQ(found[k].size, expected[k].size);
              ASSERT_EQ(found[k].pe_start, -static_cast<double>(expected[k].step_start));
              ASSERT_EQ(found[k].pe_end, -static_cast<double>(expected[k].step_end));
            }
          }
        }
  EXPECT_GT(several, 100U);
}

TEST(Ruptures, ImpossibleStatesAreRefused) {
  RuptureTracker tracker(10, 1, false);
  RuptureState state;
  state.recent.push_back({3, 5, 0});
  EXPECT_THROW(tracker.set_state(state, 5), std::invalid_argument);  // slid in no rupture
  state.open.emplace_back();
  EXPECT_NO_THROW(tracker.set_state(state, 5));
  EXPECT_THROW(tracker.set_state(state, 4), std::invalid_argument);  // slides in the future
  state.recent[0].place = 10;
  EXPECT_THROW(tracker.set_state(state, 5), std::invalid_argument);
  EXPECT_THROW(RuptureTracker(10, 0, false), std::invalid_argument);
}

// ---- the chain ----

Parameters parameters(int blocks, Scheme scheme) {
  Parameters p;
  p.blocks = blocks;
  p.scheme = scheme;
  p.dt = scheme == Scheme::printed ? 0.01 : 0.05;
  p.velocity = 0.05;
  return p;
}

// What a chain reports.
struct Watch {
  std::vector<double> slip;
  double work = 0.0;
  std::int64_t step = 0;
  int last = -1;
  void begin_step(std::int64_t to, double) {
    step = to;
    last = -1;
  }
  void slide(int block, double work_on_it, double by) {
    EXPECT_GT(block, last);
    EXPECT_GT(by, 0.0);
    last = block;
    slip[static_cast<std::size_t>(block)] += by;
    work += work_on_it;
  }
};

TEST(RupturesOfTheChain, AreThoseOfTheDisplacementsAndNothingElseChanges) {
  for (const Scheme scheme : {Scheme::printed, Scheme::verlet})
    for (const bool dense : {false, true}) {
      const Parameters p = parameters(61, scheme);
      const auto mu = random_friction(p.blocks, 0.5, 1.0, 4);
      Chain chain(p, mu, dense), alone(p, mu, false);
      Watch watch;
      watch.slip.assign(61, 0.0);
      double plate_work = 0.0, before = 0.0;
      for (int n = 0; n < 150000; ++n) {
        chain.advance(watch);
        alone.advance();
        ASSERT_EQ(chain.pe(), alone.pe());
        ASSERT_EQ(chain.dpe(), alone.dpe());
        ASSERT_EQ(watch.step, chain.step());
        // Mean force of the leaf springs on the plate over the step, times its displacement.
        const double stretch = p.blocks * chain.plate() - chain.slip_sum();
        plate_work += 0.5 * p.kl * (before + stretch) * p.velocity * p.dt;
        before = stretch;
        if (n % 100 != 0) continue;
        const std::vector<double> u = chain.displacements();
        for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR(watch.slip[i], u[i], 1e-9) << n;
      }
      EXPECT_EQ(chain.displacements(), alone.displacements());
      EXPECT_EQ(chain.velocities(), alone.velocities());
      EXPECT_GT(watch.work, 100.0);
      EXPECT_NEAR(plate_work - watch.work, direct_energy(p, chain.displacements(), chain.plate()),
                  1e-9 * watch.work);
    }
}

TEST(RupturesOfTheChain, ResumeFindsTheRowsOfTheCheckpoint) {
  // The run was killed after it had written more ruptures than its checkpoint counts, the last of
  // which ended just before the checkpoint.
  RunOptions o;
  o.parameters = parameters(60, Scheme::verlet);
  o.mu = random_friction(60, 0.5, 1.0, 3);
  o.events = Events::ruptures;
  o.header = {{"events", "ruptures"}};
  o.x_centroid = o.rupture_length = o.overwrite = true;
  o.steps = 100000;
  o.catalogue = testing::TempDir() + "slider_resume.csv";
  run(o);
  const std::string whole = text(o.catalogue);
  const auto catalogue = unit::read_catalogue(o.catalogue);
  ASSERT_GT(catalogue.events.size(), 200U);
  o.checkpoint = testing::TempDir() + "slider_resume.chk";
  for (std::size_t k = 50; k < 200; k += 50)
    for (const std::int64_t later : {0, 1, 2}) {
      std::remove(o.catalogue.c_str());
      o.resume = false;
      o.steps = catalogue.events[k].step_end + later;
      const RunResult part = run(o);
      EXPECT_EQ(part.events > static_cast<std::int64_t>(k), later >= 1) << later;
      std::ofstream(o.catalogue, std::ios::binary) << whole;
      o.resume = true;
      o.steps = 100000;
      run(o);
      EXPECT_EQ(text(o.catalogue), whole) << "rupture " << k << ", " << later;
    }
}

}  // namespace
}  // namespace Slider
