// SPDX-License-Identifier: GPL-2.0-or-later
#include "spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fftw3.h>
#include <fmt/format.h>

#include "numerics/constants.h"

namespace LSM::postproc {

namespace {

/// Subtracts the least-squares line.
void remove_trend(double *values, std::size_t count) {
  const double n = static_cast<double>(count), middle = 0.5 * (n - 1.0);
  double mean = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < count; ++i) mean += values[i] / n;
  for (std::size_t i = 0; i < count; ++i)
    moment += (static_cast<double>(i) - middle) * (values[i] - mean);
  const double slope = moment / (n * (n * n - 1.0) / 12.0);
  for (std::size_t i = 0; i < count; ++i)
    values[i] -= mean + slope * (static_cast<double>(i) - middle);
}

}  // namespace

struct WelchSpectrum::Transform {
  explicit Transform(std::size_t size)
      : in(fftw_alloc_real(size), fftw_free),
        out(fftw_alloc_complex(size / 2 + 1), fftw_free),
        plan(in && out
                 ? fftw_plan_dft_r2c_1d(static_cast<int>(size), in.get(), out.get(), FFTW_ESTIMATE)
                 : nullptr,
             fftw_destroy_plan) {
    if (!plan)
      throw std::runtime_error(
          fmt::format("cannot plan a Fourier transform of {} samples, expected fewer", size));
  }

  std::unique_ptr<double, void (*)(void *)> in;
  std::unique_ptr<fftw_complex, void (*)(void *)> out;
  std::unique_ptr<fftw_plan_s, void (*)(fftw_plan)> plan;
};

WelchSpectrum::WelchSpectrum(std::size_t n, double interval)
    : interval_(interval), hop_(n - n / 2), buffer_(n), sums_(n / 2 + 1) {
  if (n < 8 || n > static_cast<std::size_t>(std::numeric_limits<int>::max() / 2))
    throw std::invalid_argument(
        fmt::format("segment of {} samples, expected at least 8 and at most 1e9", n));
  if (!std::isfinite(interval) || !(interval > 0.0))
    throw std::invalid_argument("time between samples must be a positive number");
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * pi * static_cast<double>(i) / static_cast<double>(n);
    window_.push_back(0.5 - 0.5 * std::cos(phase));
    power_ += window_.back() * window_.back();
  }
  transform_ = std::make_unique<Transform>(n);
}

WelchSpectrum::~WelchSpectrum() = default;

void WelchSpectrum::add(double value) {
  ++samples_;
  buffer_[filled_++] = value;
  if (filled_ < buffer_.size()) return;
  add_segment();
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(hop_), buffer_.end(), buffer_.begin());
  filled_ -= hop_;
}

void WelchSpectrum::add_segment() {
  double *const in = transform_->in.get();
  std::copy(buffer_.begin(), buffer_.end(), in);
  remove_trend(in, buffer_.size());
  for (std::size_t i = 0; i < buffer_.size(); ++i) in[i] *= window_[i];
  fftw_execute(transform_->plan.get());
  const fftw_complex *const out = transform_->out.get();
  for (std::size_t k = 0; k < sums_.size(); ++k)
    sums_[k] += out[k][0] * out[k][0] + out[k][1] * out[k][1];
  ++segments_;
}

double WelchSpectrum::effective_segments() const {
  const double k = static_cast<double>(segments_);
  double product = 0.0;
  for (std::size_t i = hop_; i < window_.size(); ++i) product += window_[i] * window_[i - hop_];
  return k / (1.0 + 2.0 * (1.0 - 1.0 / k) * (product / power_) * (product / power_));
}

std::vector<SpectrumPoint> WelchSpectrum::points() const {
  if (segments_ == 0)
    throw std::invalid_argument(
        fmt::format("{} samples, expected at least one segment of {}", samples_, window_.size()));
  const std::size_t n = window_.size();
  const double step = 1.0 / (static_cast<double>(n) * interval_);
  const double averages = effective_segments();
  std::vector<SpectrumPoint> points(sums_.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    // Negative frequencies are folded onto positive ones; 0 and n/2 have no counterpart.
    const bool unpaired = k == 0 || 2 * k == n;
    points[k].frequency = static_cast<double>(k) * step;
    points[k].width = step;
    points[k].density =
        (unpaired ? 1.0 : 2.0) * sums_[k] * interval_ / (power_ * static_cast<double>(segments_));
    points[k].error = points[k].density * std::sqrt((unpaired ? 2.0 : 1.0) / averages);
  }
  return points;
}

double variance(const std::vector<SpectrumPoint> &points) {
  double sum = 0.0;
  for (const SpectrumPoint &point : points) sum += point.density * point.width;
  return sum;
}

std::vector<SpectrumPoint> averaged(const std::vector<SpectrumPoint> &points, int per_decade) {
  if (per_decade < 1) return points;
  std::vector<SpectrumPoint> out;
  const double factor = std::pow(10.0, 1.0 / per_decade);
  std::size_t begin = 0;
  while (begin < points.size()) {
    std::size_t end = begin + 1;
    if (begin > 0)
      while (end < points.size() && points[end].frequency < factor * points[begin].frequency) ++end;
    SpectrumPoint sum;
    for (std::size_t k = begin; k < end; ++k) {
      sum.width += points[k].width;
      sum.density += points[k].density * points[k].width;
      sum.error += std::pow(points[k].error * points[k].width, 2);
    }
    sum.frequency = 0.5 * (points[begin].frequency + points[end - 1].frequency);
    sum.density /= sum.width;
    sum.error = std::sqrt(sum.error) / sum.width;
    out.push_back(sum);
    begin = end;
  }
  return out;
}

}  // namespace LSM::postproc
