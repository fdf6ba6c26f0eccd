// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numerics/random.h
/// Random numbers that are the same on every platform for the same seed.
#ifndef LSM_RANDOM_H
#define LSM_RANDOM_H

#include <cmath>
#include <cstdint>
#include <random>

namespace LSM {

/// splitmix64 (Steele, Lea and Flood 2014): each state is this much larger than the one before.
constexpr std::uint64_t splitmix64_step = 0x9e3779b97f4a7c15ULL;
/// The number of splitmix64 that follows a state.
constexpr std::uint64_t splitmix64(std::uint64_t state) {
  std::uint64_t z = state + splitmix64_step;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// std::mt19937_64 with our own conversion to double: the C++ standard fixes the sequence of the
/// engine, but not that of std::uniform_real_distribution.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Next 64 random bits.
  std::uint64_t next() { return engine_(); }

  /// Uniform in [0, 1): the upper 53 bits times 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  /// Uniform in [lo, hi); returns lo when the interval is empty. Uses up one number in any case.
  double uniform(double lo, double hi) {
    const double value = lo + (hi - lo) * uniform();
    // The product may round up to hi, which the half-open interval excludes.
    if (value >= hi && hi > lo) return std::nextafter(hi, lo);
    return value;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace LSM

#endif
