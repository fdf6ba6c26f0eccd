// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over links on the packing of a fault: time per particle, compared with a plain loop over
// the same links. Options are those of Google Benchmark (--help).
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "lsm_link_kernel.h"
#include "fault/packing.h"

namespace {

using namespace LAMMPS_NS;

/// Links as one rank has them: those across the periodic border lead to ghosts on both sides.
struct Fault {
  int particles;
  std::vector<double> x, f;
  std::vector<LSMLinkRows::Link> links, to_ghosts;
  LSMLinkRows::Rows rows, rows_to_ghosts;
  std::vector<double> motion;  // LSMLinkKernel::Motion, with rows of its stride
  LSMLinkRows::Rows moving, moving_to_ghosts;

  explicit Fault(int length) {
    LSM::PackingSettings settings;
    settings.length = length;
    const LSM::Packing packing = LSM::make_packing(settings);
    particles = static_cast<int>(packing.discs.size());
    // The packing is slightly stretched, so that there are forces.
    const auto place = [&](const LSM::Disc &disc, double shift) {
      x.insert(x.end(), {1.001 * disc.x + shift, disc.y, 0.0});
    };
    for (const LSM::Disc &disc : packing.discs) place(disc, 0.0);
    const auto ghost = [&](int i, double shift) {
      place(packing.discs[i], shift);
      return static_cast<int>(x.size() / 3) - 1;
    };
    for (const auto &link : packing.links) {
      const LSM::Disc &a = packing.discs[link.first], &b = packing.discs[link.second];
      const double rest = a.r + b.r, period = b.x > a.x ? length : -length;
      if (std::fabs(b.x - a.x) < 0.5 * length) {
        links.push_back({link.first, link.second, rest});
      } else {
        to_ghosts.push_back({link.first, ghost(link.second, -period), rest});
        to_ghosts.push_back({link.second, ghost(link.first, period), rest});
      }
    }
    f.assign(x.size(), 0.0);
    std::vector<int> owned(particles);
    std::iota(owned.begin(), owned.end(), 0);
    const int all = static_cast<int>(x.size() / 3);
    const auto make = [&](const std::vector<LSMLinkRows::Link> &some, bool mixed, int stride) {
      return LSMLinkRows::make_rows(owned, some, particles, all, mixed, true, stride, false);
    };
    rows = make(links, false, 3);
    rows_to_ghosts = make(to_ghosts, true, 3);
    using Motion = LSMLinkKernel::Motion<2>;
    moving = make(links, false, Motion::SIZE);
    moving_to_ghosts = make(to_ghosts, true, Motion::SIZE);
    for (int i = 0; i < all; ++i) motion.insert(motion.end(), {1e-3, 0.0, x[3 * i], x[3 * i + 1]});
  }

  static Fault &of(int length) {
    static std::map<int, std::unique_ptr<Fault>> made;
    auto &one = made[length];
    if (!one) one = std::make_unique<Fault>(length);
    return *one;
  }
};

void report(benchmark::State &state, const Fault &fault) {
  state.counters["s_per_particle"] = benchmark::Counter(
      fault.particles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Law>
void rows(benchmark::State &state, const Law &law) {
  Fault &fault = Fault::of(static_cast<int>(state.range(0)));
  std::vector<LSMLinkRows::Found> broken;
  const bool avx2 = state.range(1) && LSMLinkKernel::has_avx2();
  const auto &inside = Law::viscous ? fault.moving : fault.rows;
  const auto &across = Law::viscous ? fault.moving_to_ghosts : fault.rows_to_ghosts;
  for (auto _ : state) {
    double energy = 0.0;
    const auto add = [&](const LSMLinkRows::Rows &some, bool first_only) {
      energy += LSMLinkKernel::forces<2>(some, {0, static_cast<int>(some.windows.size()) - 1}, law,
                                         first_only, fault.x.data(), fault.f.data(), broken, avx2);
    };
    add(inside, false);
    add(across, true);
    benchmark::DoNotOptimize(energy);
  }
  report(state, fault);
}

void elastic(benchmark::State &state) { rows(state, LSMLinkKernel::Elastic{1.0}); }
void dashpots(benchmark::State &state) {
  double lost = 0.0;
  const double *const motion = Fault::of(static_cast<int>(state.range(0))).motion.data();
  rows(state, LSMLinkKernel::KelvinVoigt<LSMLinkKernel::Elastic>{{1.0}, 0.005, &lost, motion});
}
void breakable(benchmark::State &state) { rows(state, LSMLinkKernel::Breakable{{1.0}, 2.0}); }

void plain_loop(benchmark::State &state) {
  Fault &fault = Fault::of(static_cast<int>(state.range(0)));
  double *const f = fault.f.data();
  const double *const x = fault.x.data();
  for (auto _ : state) {
    double energy = 0.0;
    const auto pull = [&](const LSMLinkRows::Link &link, bool both) {
      const double dx = x[3 * link.i] - x[3 * link.j], dy = x[3 * link.i + 1] - x[3 * link.j + 1];
      const double r = std::sqrt(dx * dx + dy * dy), stretch = r - link.rest;
      const double over = stretch / r;
      energy += (both ? 0.5 : 0.25) * stretch * stretch;
      f[3 * link.i] -= over * dx;
      f[3 * link.i + 1] -= over * dy;
      if (!both) return;
      f[3 * link.j] += over * dx;
      f[3 * link.j + 1] += over * dy;
    };
    for (const auto &link : fault.links) pull(link, true);
    for (const auto &link : fault.to_ghosts) pull(link, false);
    benchmark::DoNotOptimize(energy);
  }
  report(state, fault);
}

void make_lists(benchmark::State &state) {
  Fault &fault = Fault::of(static_cast<int>(state.range(0)));
  std::vector<int> owned(fault.particles);
  std::iota(owned.begin(), owned.end(), 0);
  for (auto _ : state)
    benchmark::DoNotOptimize(LSMLinkRows::make_rows(owned, fault.links, fault.particles,
                                                    static_cast<int>(fault.x.size() / 3), false,
                                                    true, 3, false));
  report(state, fault);
}

const std::vector<int64_t> lengths = {120, 945, 1890, 3780};
BENCHMARK(elastic)->ArgNames({"length", "avx2"})->ArgsProduct({lengths, {1, 0}});
BENCHMARK(dashpots)->ArgNames({"length", "avx2"})->ArgsProduct({lengths, {1}});
BENCHMARK(breakable)->ArgNames({"length", "avx2"})->ArgsProduct({lengths, {1}});
BENCHMARK(plain_loop)->ArgName("length")->ArgsProduct({lengths});
BENCHMARK(make_lists)->ArgName("length")->ArgsProduct({lengths});

}  // namespace

BENCHMARK_MAIN();
