// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_modes.h"

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <stdexcept>

namespace Slider {

namespace {

// Only the execution of a plan may be left to several threads.
std::mutex &planner() {
  static std::mutex one;
  return one;
}

fftw_complex *of(std::complex<double> *p) { return reinterpret_cast<fftw_complex *>(p); }

}  // namespace

void ModeForces::Free::operator()(void *p) const { fftw_free(p); }

ModeForces::ModeForces(const std::vector<double> &modes, int blocks)
    : blocks_(blocks),
      values_(fftw_alloc_real(static_cast<std::size_t>(blocks))),
      spectrum_(reinterpret_cast<std::complex<double> *>(fftw_alloc_complex(modes.size()))) {
  if (modes.size() != static_cast<std::size_t>(blocks / 2 + 1))
    throw std::invalid_argument("number of modes differs from --blocks");
  if (!values_ || !spectrum_) throw std::bad_alloc();
  for (const double stiffness : modes)
    factors_.insert(factors_.end(), 2, -(stiffness - modes[0]) / blocks);
  const std::lock_guard<std::mutex> lock(planner());
  forward_ = fftw_plan_dft_r2c_1d(blocks, values_.get(), of(spectrum_.get()), FFTW_ESTIMATE);
  backward_ = fftw_plan_dft_c2r_1d(blocks, of(spectrum_.get()), values_.get(), FFTW_ESTIMATE);
}

ModeForces::~ModeForces() {
  const std::lock_guard<std::mutex> lock(planner());
  fftw_destroy_plan(forward_);
  fftw_destroy_plan(backward_);
}

void ModeForces::find(const double *u, double *force) {
  double *const values = values_.get();
  // Blocks move far, but not apart: digits are not wasted on what they have in common.
  const double common = u[0];
  for (int i = 0; i < blocks_; ++i) values[i] = u[i] - common;
  fftw_execute(forward_);
  double *const spectrum = reinterpret_cast<double *>(spectrum_.get());
  for (std::size_t n = 0; n < factors_.size(); ++n) spectrum[n] *= factors_[n];
  fftw_execute(backward_);
  std::copy_n(values, blocks_, force);
}

}  // namespace Slider
