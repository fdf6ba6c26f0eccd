// SPDX-License-Identifier: GPL-2.0-or-later
#include "fault/frequency.h"

#include "numerics/constants.h"
#include "numerics/random.h"

namespace LSM {

void add_spring_forces(const std::vector<PairSpring> &springs, int dim,
                       const std::vector<double> &displacement, std::vector<double> &force) {
  if (dim == 3)
    add_spring_forces<3>(springs, displacement, force);
  else
    add_spring_forces<2>(springs, displacement, force);
}

std::pair<double, double> normal_pair(std::uint64_t key, std::uint64_t axis) {
  std::uint64_t state = key * 4 + axis;
  auto uniform = [&state] {  // in (0, 1]
    const std::uint64_t bits = splitmix64(state);
    state += splitmix64_step;
    return (static_cast<double>(bits >> 11) + 1.0) * 0x1.0p-53;
  };
  state = static_cast<std::uint64_t>(uniform() * 0x1.0p53);
  const double length = std::sqrt(-2.0 * std::log(uniform()));
  const double angle = 2.0 * pi * uniform();
  return {length * std::cos(angle), length * std::sin(angle)};
}

double largest_of_tridiagonal(const std::vector<double> &diagonal,
                              const std::vector<double> &beside) {
  const std::size_t n = diagonal.size();
  double low = diagonal[0], high = diagonal[0];
  for (std::size_t i = 0; i < n; ++i) {
    const double reach =
        (i > 0 ? std::fabs(beside[i - 1]) : 0.0) + (i + 1 < n ? std::fabs(beside[i]) : 0.0);
    low = std::max(low, diagonal[i]);
    high = std::max(high, diagonal[i] + reach);
  }
  // x is above all eigenvalues if all pivots of the matrix minus x are negative.
  auto above = [&](double x) {
    double pivot = diagonal[0] - x;
    for (std::size_t i = 1; i < n && pivot < 0.0; ++i)
      pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
    return pivot < 0.0;
  };
  for (int halving = 0; halving < 200; ++halving) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (above(middle) ? high : low) = middle;
  }
  return high;
}

int lanczos_steps(double dimensions) {
  const double root = std::sqrt(eigenvalue_share);
  return static_cast<int>(
      std::ceil(0.5 + std::log(1.648 * std::sqrt(dimensions) / eigenvalue_risk) /
                          std::log((1.0 + root) / (1.0 - root))));
}

}  // namespace LSM
