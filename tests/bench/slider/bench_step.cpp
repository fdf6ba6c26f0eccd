// SPDX-License-Identifier: GPL-2.0-or-later
// Time of one step in which all blocks move, or a contiguous tenth of them, coupled by springs or
// by modes, and of the two transforms that modes need, with plans of the same kind and nothing
// else. The rest of a step is friction law, time stepping and sums.
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>

#include "slider_chain.h"
#include "slider_stiffness.h"

namespace {

using namespace Slider;

void step(benchmark::State &state, Coupling coupling, Scheme scheme, int moving = 1,
          Law law = Law::velocity_weakening) {
  Parameters p;
  p.friction.law = law;
  p.blocks = static_cast<int>(state.range(0));
  p.velocity = 1.0;
  p.scheme = scheme;
  if (scheme == Scheme::adams_bashforth) {
    p.mass = 0.0;
    p.radiation = 1.0;
  }
  if (coupling != Coupling::chain)
    p.modes = modes_of(coupling, strip_of_leaf_spring(coupling, p.kc, p.kl), p.blocks);
  auto strengths = random_friction(p.blocks, 0.0, 0.01, 1);
  std::fill(strengths.begin() + p.blocks / moving, strengths.end(), 1e9);
  Chain chain(p, strengths, true);
  for (int n = 0; n < 1000; ++n) chain.advance();
  for (auto _ : state) chain.advance();
}

void transforms(benchmark::State &state) {
  const int n = static_cast<int>(state.range(0));
  double *const values = fftw_alloc_real(static_cast<std::size_t>(n));
  double *const back = fftw_alloc_real(static_cast<std::size_t>(n));
  fftw_complex *const spectrum = fftw_alloc_complex(static_cast<std::size_t>(n / 2 + 1));
  const fftw_plan forward = fftw_plan_dft_r2c_1d(n, values, spectrum, FFTW_ESTIMATE);
  const fftw_plan backward = fftw_plan_dft_c2r_1d(n, spectrum, back, FFTW_ESTIMATE);
  for (int i = 0; i < n; ++i) values[i] = 1e-3 * i;
  for (auto _ : state) {
    fftw_execute(forward);
    fftw_execute(backward);
  }
  fftw_destroy_plan(forward);
  fftw_destroy_plan(backward);
  fftw_free(values);
  fftw_free(back);
  fftw_free(spectrum);
}

void sizes(benchmark::internal::Benchmark *b) {
  for (const int n : {256, 512, 1024, 1928, 2048, 16384}) b->Arg(n);
}

BENCHMARK_CAPTURE(step, springs, Coupling::chain, Scheme::verlet)->Apply(sizes);
BENCHMARK_CAPTURE(step, antiplane, Coupling::antiplane, Scheme::verlet)->Apply(sizes);
BENCHMARK_CAPTURE(step, antiplane_tenth, Coupling::antiplane, Scheme::verlet, 10)->Apply(sizes);
BENCHMARK_CAPTURE(step, coulomb, Coupling::antiplane, Scheme::verlet, 1, Law::coulomb)
    ->Apply(sizes);
BENCHMARK_CAPTURE(step, coulomb_tenth, Coupling::antiplane, Scheme::verlet, 10, Law::coulomb)
    ->Apply(sizes);
BENCHMARK_CAPTURE(step, no_inertia, Coupling::antiplane, Scheme::adams_bashforth, 1, Law::coulomb)
    ->Apply(sizes);
BENCHMARK(transforms)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
