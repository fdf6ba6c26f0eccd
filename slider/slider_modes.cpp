// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_modes.h"

#include <fftw3.h>

#include <stdexcept>

namespace Slider {

ModeForces::ModeForces(const std::vector<double> &modes, int blocks) : blocks_(blocks) {
  if (modes.size() != static_cast<std::size_t>(blocks / 2 + 1))
    throw std::invalid_argument("number of modes differs from --blocks");
  for (const double stiffness : modes)
    factors_.insert(factors_.end(), 2, -(stiffness - modes[0]) / blocks);
  factors_.resize(whole_chunks(factors_.size()));
  spectrum_.resize(factors_.size());
  apart_.resize(whole_chunks(static_cast<std::size_t>(blocks)));
  coupling_.resize(apart_.size());
  arrays_ = {apart_.data(), spectrum_.data(), factors_.data(), static_cast<int>(factors_.size()),
             coupling_.data()};
  auto *const spectrum = reinterpret_cast<fftw_complex *>(spectrum_.data());
  forward_ = fftw_plan_dft_r2c_1d(blocks, apart_.data(), spectrum, FFTW_ESTIMATE);
  backward_ = fftw_plan_dft_c2r_1d(blocks, spectrum, coupling_.data(), FFTW_ESTIMATE);
}

ModeForces::~ModeForces() {
  fftw_destroy_plan(forward_);
  fftw_destroy_plan(backward_);
}

void ModeForces::transform() { fftw_execute(forward_); }
void ModeForces::transform_back() { fftw_execute(backward_); }

const double *ModeForces::find(const double *u) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(blocks_); ++i) apart_[i] = u[i] - u[0];
  transform();
  for (std::size_t n = 0; n < factors_.size(); ++n) spectrum_[n] *= factors_[n];
  transform_back();
  return coupling_.data();
}

}  // namespace Slider
