// SPDX-License-Identifier: GPL-2.0-or-later
/// \file spectrum.h
/// Power spectral density of an evenly sampled series by Welch's method (IEEE Trans. Audio
/// Electroacoust. AU-15, 1967): mean of the periodograms of windowed, overlapping segments. Ours;
/// the paper shows no spectra.
#ifndef LSM_POSTPROC_SPECTRUM_H
#define LSM_POSTPROC_SPECTRUM_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace LSM::postproc {

enum class Window { hann, hamming, blackman, rectangular };
enum class Detrend { none, mean, linear };  ///< what is taken off each segment

struct SpectrumSettings {
  std::size_t segment = 4096;  ///< samples in a segment, >= 8
  double overlap = 0.5;        ///< part of a segment shared with the next, 0 <= overlap < 1
  Window window = Window::hann;
  Detrend detrend = Detrend::linear;
};

/// One-sided density: the sum of density * width over all points is the variance of the series
/// (exactly for one rectangular segment without detrending but for the mean).
struct SpectrumPoint {
  double frequency = 0.0;  ///< middle, in cycles per time
  double width = 0.0;      ///< frequencies it stands for
  double density = 0.0;    ///< square of the series' unit times time
  double error = 0.0;      ///< standard error, for noise that is Gaussian within a segment
};

/// Streaming: memory for a few segments, whatever the length of the series.
class WelchSpectrum {
 public:
  /// \param interval time between samples, > 0. \throws std::invalid_argument
  WelchSpectrum(const SpectrumSettings &settings, double interval);
  ~WelchSpectrum();
  WelchSpectrum(const WelchSpectrum &) = delete;
  WelchSpectrum &operator=(const WelchSpectrum &) = delete;

  void add(double value);
  std::int64_t samples() const { return samples_; }
  std::int64_t segments() const { return segments_; }
  /// Number of independent segments with the same scatter of their mean (Welch 1967).
  double effective_segments() const;

  /// Frequencies 0 to half the sampling rate. \throws std::invalid_argument before the first
  /// segment is full.
  std::vector<SpectrumPoint> points() const;

 private:
  struct Transform;
  void add_segment();

  SpectrumSettings settings_;
  double interval_ = 1.0;
  std::size_t hop_ = 0, filled_ = 0;
  std::int64_t samples_ = 0, segments_ = 0;
  double power_ = 0.0;  // sum of the squares of the window
  std::vector<double> window_, buffer_, sums_;
  std::unique_ptr<Transform> transform_;
};

/// Integral of the density.
double variance(const std::vector<SpectrumPoint> &points);

/// Neighbours averaged so that there are at most per_decade points in a decade of frequency; the
/// integral stays. Frequency 0 is a point of its own.
std::vector<SpectrumPoint> averaged(const std::vector<SpectrumPoint> &points, int per_decade);

}  // namespace LSM::postproc

#endif
