// SPDX-License-Identifier: GPL-2.0-or-later
/// \file spectrum.h
/// Power spectral density of an evenly sampled series by Welch's method (IEEE Trans. Audio
/// Electroacoust. AU-15, 1967): mean periodogram of segments that overlap by half, each detrended
/// linearly and multiplied by a Hann window. Our own addition; the paper shows no spectra.
#ifndef LSM_POSTPROC_SPECTRUM_H
#define LSM_POSTPROC_SPECTRUM_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace LSM::postproc {

/// One-sided density: the sum of density * width over all points is the variance of the series.
struct SpectrumPoint {
  double frequency = 0.0;  ///< centre, in cycles per unit of time
  double width = 0.0;      ///< width of the band of frequencies
  double density = 0.0;    ///< square of the series' unit times time
  double error = 0.0;      ///< standard error for noise that is Gaussian within a segment
};

/// Streaming estimator: its memory is that of a few segments, whatever the length of the series.
class WelchSpectrum {
 public:
  /// \param segment number of samples in a segment, at least 8
  /// \param interval time between samples, > 0
  /// \throws std::invalid_argument for other values
  WelchSpectrum(std::size_t segment, double interval);
  ~WelchSpectrum();

  void add(double value);
  std::int64_t samples() const { return samples_; }
  std::int64_t segments() const { return segments_; }
  /// Number of independent segments whose mean has the same scatter (Welch 1967).
  double effective_segments() const;

  /// Spectrum at the frequencies from 0 to half the sampling rate.
  /// \throws std::invalid_argument before the first segment is full
  std::vector<SpectrumPoint> points() const;

 private:
  struct Transform;
  void add_segment();

  double interval_;
  std::size_t hop_, filled_ = 0;
  std::int64_t samples_ = 0, segments_ = 0;
  double power_ = 0.0;  // sum of the squares of the window
  std::vector<double> window_, buffer_, sums_;
  std::unique_ptr<Transform> transform_;
};

/// Integral of the density over all frequencies.
double variance(const std::vector<SpectrumPoint> &points);

/// Averages neighbouring points so that there are at most per_decade in a decade of frequency; the
/// integral is preserved. Frequency 0 remains a point of its own.
/// \param per_decade below 1: nothing is averaged
std::vector<SpectrumPoint> averaged(const std::vector<SpectrumPoint> &points, int per_decade);

}  // namespace LSM::postproc

#endif
