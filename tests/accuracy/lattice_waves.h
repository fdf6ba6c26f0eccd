// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lattice_waves.h
/// Closed forms for waves of the triangular lattice, with which the waves computed by lmp are
/// compared.
#ifndef LSM_ACCURACY_LATTICE_WAVES_H
#define LSM_ACCURACY_LATTICE_WAVES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lattice_waves {

constexpr double pi = 3.14159265358979323846;

/// Speeds of long waves for spacing, stiffness and mass of 1.
const double vp = std::sqrt(9.0 / 8.0), vs = std::sqrt(3.0 / 8.0);

struct Mode {
  double frequency;                    ///< angular
  std::array<double, 2> polarisation;  ///< unit vector
};

/// Plane wave of the wave vector (kx, ky), x along a row: the faster mode (P) or the slower one
/// (S). m w^2 u = sum over the links of 2 k (1 - cos(K.n)) n (n.u), K wave vector, n link, three
/// directions of links.
inline Mode plane_wave(double kx, double ky, bool p) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const double angle : {0.0, pi / 3.0, 2.0 * pi / 3.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double pull = 2.0 * (1.0 - std::cos(kx * c + ky * s));
    xx += pull * c * c;
    xy += pull * c * s;
    yy += pull * s * s;
  }
  const double mean = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
  const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy) + (p ? 0.0 : 0.5 * pi);
  return {std::sqrt(mean + (p ? apart : -apart)), {std::cos(turn), std::sin(turn)}};
}

/// Rayleigh waves of a half-space: speed over that of S-waves, the root below 1 of
/// (2 - c^2)^2 = 4 sqrt(1 - c^2) sqrt(1 - c^2 (vs/vp)^2).
inline double rayleigh(double ratio) {
  double low = 0.5, high = 1.0;
  for (int n = 0; n < 100; ++n) {
    const double c = 0.5 * (low + high), c2 = c * c;
    const double left = (2.0 - c2) * (2.0 - c2);
    (left < 4.0 * std::sqrt((1.0 - c2) * (1.0 - c2 / (ratio * ratio))) ? low : high) = c;
  }
  return low;
}

/// A zero of a standing wave.
struct Zero {
  double time;
  double peak;  ///< largest amplitude since the zero before
};

/// Finds the zeros in samples (time, amplitude).
inline std::vector<Zero> zeros(const std::vector<std::pair<double, double>> &samples) {
  std::vector<Zero> found;
  double peak = 0.0;
  for (std::size_t n = 1; n < samples.size(); ++n) {
    const auto [t, a] = samples[n - 1];
    const auto [u, b] = samples[n];
    peak = std::max(peak, std::fabs(b));
    if (a * b >= 0.0) continue;
    found.push_back({t + (u - t) * a / (a - b), peak});
    peak = 0.0;
  }
  return found;
}

/// Angular frequency from at least two zeros.
inline double frequency(const std::vector<Zero> &zeros) {
  return pi * static_cast<double>(zeros.size() - 1) / (zeros.back().time - zeros.front().time);
}

}  // namespace lattice_waves

#endif
