// SPDX-License-Identifier: GPL-2.0-or-later
#include "spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <stdexcept>
#include <vector>

using namespace LSM::postproc;

namespace {

constexpr double pi = 3.14159265358979323846;

double integral(const std::vector<SpectrumPoint> &points) {
  double sum = 0.0;
  for (const SpectrumPoint &point : points) sum += point.density * point.width;
  return sum;
}

std::vector<double> noise(std::size_t count, unsigned seed, double sigma = 1.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  std::vector<double> values(count);
  for (double &value : values) value = normal(random);
  return values;
}

WelchSpectrum &feed(WelchSpectrum &spectrum, const std::vector<double> &values) {
  for (const double value : values) spectrum.add(value);
  return spectrum;
}

/// Weight of sample i of n.
double hann(std::size_t i, std::size_t n) {
  return std::pow(std::sin(pi * static_cast<double>(i) / static_cast<double>(n)), 2);
}

/// n values from `begin` on, less their least-squares line.
std::vector<double> without_line(const std::vector<double> &values, std::size_t begin,
                                 std::size_t n) {
  double sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i), y = values[begin + i];
    sx += x;
    sxx += x * x;
    sy += y;
    sxy += x * y;
  }
  const double count = static_cast<double>(n);
  const double slope = (count * sxy - sx * sy) / (count * sxx - sx * sx);
  std::vector<double> rest;
  for (std::size_t i = 0; i < n; ++i)
    rest.push_back(values[begin + i] - (sy - slope * sx) / count - slope * static_cast<double>(i));
  return rest;
}

}  // namespace

// Parseval's theorem for one segment of even or odd length, with squares weighted by the window.
TEST(Spectrum, IntegralIsTheVariance) {
  for (const std::size_t n : {64u, 65u}) {
    std::vector<double> values = noise(n, 3);
    for (std::size_t i = 0; i < n; ++i) values[i] += 5.0 + 0.1 * static_cast<double>(i);
    const std::vector<double> rest = without_line(values, 0, n);
    double variance = 0.0, power = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      variance += std::pow(hann(i, n) * rest[i], 2);
      power += std::pow(hann(i, n), 2);
    }
    WelchSpectrum spectrum(n, 0.03);
    EXPECT_NEAR(integral(feed(spectrum, values).points()), variance / power, 1e-12);
  }
}

// Compares the spectrum with a transform written out as a sum.
TEST(Spectrum, AgreesWithTheDefinition) {
  const std::size_t n = 16;
  const double dt = 0.25;
  const std::vector<double> values = noise(40, 4);
  WelchSpectrum spectrum(n, dt);
  const std::vector<SpectrumPoint> points = feed(spectrum, values).points();
  ASSERT_EQ(spectrum.segments(), 4);  // 0, 8, 16, 24
  ASSERT_EQ(points.size(), n / 2 + 1);
  double power = 0.0;
  for (std::size_t i = 0; i < n; ++i) power += std::pow(hann(i, n), 2);
  for (std::size_t k = 0; k <= n / 2; ++k) {
    double mean = 0.0;
    for (std::size_t begin = 0; begin <= 24; begin += 8) {
      const std::vector<double> rest = without_line(values, begin, n);
      std::complex<double> sum;
      for (std::size_t i = 0; i < n; ++i)
        sum += hann(i, n) * rest[i] *
               std::polar(1.0, -2.0 * pi * static_cast<double>(i * k) / static_cast<double>(n));
      mean += std::norm(sum) / 4.0;
    }
    const double sides = k == 0 || k == n / 2 ? 1.0 : 2.0;
    EXPECT_NEAR(points[k].density, sides * mean * dt / power, 1e-12 * mean) << k;
    EXPECT_DOUBLE_EQ(points[k].frequency, static_cast<double>(k) / (16 * dt));
    EXPECT_DOUBLE_EQ(points[k].width, 1.0 / (16 * dt));
  }
}

TEST(Spectrum, SineHasHalfTheSquareOfItsAmplitude) {
  const double amplitude = 0.7, dt = 0.03;
  const std::size_t n = 256;
  WelchSpectrum spectrum(n, dt);
  // With 20 periods in a segment, all power is within the main lobe of the window. A cosine that is
  // symmetric about the middle of each segment has no trend.
  for (int i = 0; i < 4096; ++i)
    spectrum.add(3.0 + amplitude * std::cos(2.0 * pi * 20.0 * (i + 0.5) / static_cast<double>(n)));
  const std::vector<SpectrumPoint> points = spectrum.points();
  const double variance = 0.5 * amplitude * amplitude;
  EXPECT_NEAR(integral(points), variance, 1e-9);
  double near = 0.0;
  for (std::size_t k = 17; k <= 23; ++k) near += points[k].density * points[k].width;
  EXPECT_NEAR(near, variance, 1e-9);
  EXPECT_GT(points[20].density, points[19].density);
  EXPECT_GT(points[20].density, points[21].density);
  EXPECT_NEAR(points[20].frequency, 20.0 / (256 * dt), 1e-12);
}

// The spectrum of white noise is flat, 2 sigma^2 dt, and its scatter agrees with the stated errors.
TEST(Spectrum, WhiteNoiseLevelAndErrors) {
  const double sigma = 0.3, dt = 0.05, level = 2.0 * sigma * sigma * dt;
  double sum = 0.0, scatter = 0.0;
  std::size_t count = 0;
  for (const unsigned seed : {11u, 12u, 13u, 14u, 15u, 16u, 17u, 18u}) {
    WelchSpectrum spectrum(128, dt);
    const std::vector<SpectrumPoint> points =
        feed(spectrum, noise(128 * 400, seed, sigma)).points();
    for (std::size_t k = 2; k < 63; ++k, ++count) {
      sum += points[k].density / level;
      scatter +=
          std::pow((points[k].density - level) / (level * points[k].error / points[k].density), 2);
    }
  }
  // 488 points have a relative error near 1/20, up to half of which neighbours share.
  EXPECT_NEAR(sum / static_cast<double>(count), 1.0, 0.011);
  // The mean square of 488 correlated normal deviates has a standard error below 0.1.
  EXPECT_NEAR(scatter / static_cast<double>(count), 1.0, 0.27);
}

TEST(Spectrum, OverlapGivesMoreIndependentSegmentsButNotAsMany) {
  const std::vector<double> values = noise(64 * 50, 5);
  WelchSpectrum half(64, 1.0);
  feed(half, values);
  EXPECT_EQ(half.segments(), 99);
  // Half-overlapping Hann windows correlate by 1/6: rho^2 = 1/36 (Welch 1967).
  EXPECT_NEAR(half.effective_segments(), 99.0 / (1.0 + 2.0 * (98.0 / 99.0) / 36.0), 1e-9);
}

TEST(Spectrum, DetrendTakesOffTheLine) {
  WelchSpectrum line(64, 1.0);
  for (int i = 0; i < 640; ++i) line.add(100.0 + 0.25 * i);
  EXPECT_LT(integral(line.points()), 1e-20);
}

TEST(Spectrum, AveragingKeepsTheIntegral) {
  WelchSpectrum spectrum(1024, 0.1);
  const std::vector<SpectrumPoint> all = feed(spectrum, noise(1 << 14, 6)).points();
  const std::vector<SpectrumPoint> few = averaged(all, 10);
  EXPECT_NEAR(integral(few), integral(all), 1e-12 * integral(all));
  EXPECT_LT(few.size(), 32u);
  EXPECT_EQ(few.front().frequency, 0.0);
  for (std::size_t i = 1; i < few.size(); ++i) {
    EXPECT_GT(few[i].frequency, few[i - 1].frequency);
    EXPECT_GT(few[i].error, 0.0);
  }
  EXPECT_LT(few.back().error / few.back().density, 0.3 * all.back().error / all.back().density);
  EXPECT_EQ(averaged(all, 0).size(), all.size());
}

TEST(Spectrum, ImpossibleSettingsAreRefused) {
  EXPECT_THROW(WelchSpectrum(4, 1.0), std::invalid_argument);
  EXPECT_THROW(WelchSpectrum(64, 0.0), std::invalid_argument);
  WelchSpectrum spectrum(64, 1.0);
  feed(spectrum, noise(63, 1));
  EXPECT_THROW(spectrum.points(), std::invalid_argument);
}
