// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault/frequency.h
/// Upper bound on the highest frequency of a network of masses and springs, for checking the time
/// step.
///
/// Lanczos iteration from a random start. The largest Ritz value approaches the largest eigenvalue
/// from below, and no residual tells whether a mode confined to a few discs has been missed. The
/// random start gives the bound: after k steps in n dimensions the largest eigenvalue of a positive
/// semi-definite matrix exceeds the Ritz value by more than a fraction e of itself with a
/// probability of at most 1.648 sqrt(n) ((1 - sqrt e) / (1 + sqrt e))^(k - 1/2), for any matrix
/// (Kuczynski and Wozniakowski, SIAM J. Matrix Anal. Appl. 13, 1094, 1992, Theorem 4.2).
#ifndef LSM_FREQUENCY_H
#define LSM_FREQUENCY_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace LSM {

/// A spring between particles i and j along the unit vector n, with stiffness k along it and kt
/// across it, and the viscosity of a dashpot along it. Unless `both`, the force on j is not added;
/// the rank that owns j adds it.
struct PairSpring {
  int i, j;
  bool both;
  double k, kt;
  std::array<double, 3> n;
  double viscosity = 0.0;
};

/// Adds the forces with which the springs resist the displacements; `axes` values per particle.
template <std::size_t axes>
void add_spring_forces(const std::vector<PairSpring> &springs,
                       const std::vector<double> &displacement, std::vector<double> &force) {
  for (const PairSpring &s : springs) {
    const double *const ui = displacement.data() + static_cast<std::size_t>(s.i) * axes;
    const double *const uj = displacement.data() + static_cast<std::size_t>(s.j) * axes;
    double *const fi = force.data() + static_cast<std::size_t>(s.i) * axes;
    double *const fj = force.data() + static_cast<std::size_t>(s.j) * axes;
    double u[axes], along = 0.0;
    for (std::size_t c = 0; c < axes; ++c) {
      u[c] = ui[c] - uj[c];
      along += u[c] * s.n[c];
    }
    along *= s.k - s.kt;
    for (std::size_t c = 0; c < axes; ++c) {
      const double f = along * s.n[c] + s.kt * u[c];
      fi[c] += f;
      if (s.both) fj[c] -= f;
    }
  }
}

void add_spring_forces(const std::vector<PairSpring> &springs, int dim,
                       const std::vector<double> &displacement, std::vector<double> &force);

/// Two independent normal random numbers that are determined by key and axis, so that a start
/// vector does not depend on the order of the particles or on the ranks that own them.
std::pair<double, double> normal_pair(std::uint64_t key, std::uint64_t axis);

/// Largest eigenvalue of the symmetric tridiagonal matrix, by bisection with Sturm sequences.
double largest_of_tridiagonal(const std::vector<double> &diagonal,
                              const std::vector<double> &beside);

/// Largest eigenvalue of a positive semi-definite matrix.
struct LargestEigenvalue {
  double found = 0.0;  ///< Ritz value, which is not above the eigenvalue
  double bound = 0.0;  ///< bound that the eigenvalue exceeds with probability eigenvalue_risk only
  int steps = 0;       ///< products with the matrix
};

/// The fraction by which the eigenvalue may exceed the Ritz value, and the probability that it
/// exceeds it by more.
constexpr double eigenvalue_share = 0.05;
constexpr double eigenvalue_risk = 1e-12;

/// Number of steps after which the Ritz value is accurate to eigenvalue_share.
int lanczos_steps(double dimensions);

/// Estimates the largest eigenvalue of a positive semi-definite matrix by Lanczos iteration.
/// \param start this rank's share of a vector of independent normal numbers
/// \param dimensions length of this vector on all ranks together
/// \param multiply multiply(x, y) sets y to the matrix times x
/// \param sum sum(a) adds up over the ranks
template <class Multiply, class Sum>
LargestEigenvalue largest_eigenvalue(std::vector<double> start, double dimensions,
                                     Multiply &&multiply, Sum &&sum) {
  LargestEigenvalue result;
  auto dot = [&sum](const std::vector<double> &a, const std::vector<double> &b) {
    double mine = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) mine += a[n] * b[n];
    return sum(mine);
  };
  std::vector<double> v = std::move(start), before(v.size(), 0.0), next(v.size(), 0.0);
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0.0)) return result;
  for (double &x : v) x /= length;

  const int steps = lanczos_steps(dimensions);
  std::vector<double> diagonal, beside;
  double off = 0.0;
  bool complete = false;  // the Krylov space is exhausted
  while (result.steps < steps && !complete) {
    multiply(v, next);
    ++result.steps;
    for (std::size_t n = 0; n < v.size(); ++n) next[n] -= off * before[n];
    const double on = dot(v, next);
    for (std::size_t n = 0; n < v.size(); ++n) next[n] -= on * v[n];
    off = std::sqrt(dot(next, next));
    diagonal.push_back(on);
    beside.push_back(off);
    result.found = std::max(result.found, on);
    complete = !(off > 1e-13 * result.found);
    if (complete) break;
    before.swap(v);
    v.swap(next);
    for (double &x : v) x /= off;
  }
  result.found = largest_of_tridiagonal(diagonal, beside);
  result.bound = complete ? result.found * (1.0 + 1e-9) : result.found / (1.0 - eigenvalue_share);
  return result;
}

/// One rank's masses and springs. Particles are numbered with the owned ones first, then the
/// ghosts, which are owned by another rank or are images beyond a periodic boundary.
struct SpringNetwork {
  int dim = 2;                    ///< 2 or 3
  std::vector<double> mass;       ///< of the owned particles
  std::vector<std::uint64_t> id;  ///< of the owned particles, for the start vector
  std::size_t ghosts = 0;
  std::vector<PairSpring> springs;
};

/// Square of the highest frequency: the largest eigenvalue of M^-1/2 K M^-1/2.
/// \param dimensions degrees of freedom on all ranks together
/// \param displacement,force buffers of the caller, `dim` values per particle
/// \param to_ghosts copies displacements of owned particles to their ghosts
/// \param from_ghosts adds the forces on ghosts to those on owned particles, or does nothing if no
/// spring exerts any
/// \param sum sum(a) adds up over the ranks
template <class ToGhosts, class FromGhosts, class Sum>
LargestEigenvalue highest_frequency_squared(const SpringNetwork &network, double dimensions,
                                            std::vector<double> &displacement,
                                            std::vector<double> &force, ToGhosts &&to_ghosts,
                                            FromGhosts &&from_ghosts, Sum &&sum) {
  const auto dim = static_cast<std::size_t>(network.dim);
  const std::size_t size = network.mass.size() * dim;
  std::vector<double> scale(size), start(size);
  for (std::size_t i = 0; i < network.mass.size(); ++i)
    for (std::size_t c = 0; c < dim; ++c) {
      scale[i * dim + c] = 1.0 / std::sqrt(network.mass[i]);
      const auto pair = normal_pair(network.id[i], c - c % 2);
      start[i * dim + c] = c % 2 == 0 ? pair.first : pair.second;
    }
  const auto multiply = [&](const std::vector<double> &from, std::vector<double> &to) {
    displacement.resize(size + network.ghosts * dim);
    for (std::size_t n = 0; n < size; ++n) displacement[n] = from[n] * scale[n];
    to_ghosts();
    force.assign(displacement.size(), 0.0);
    add_spring_forces(network.springs, network.dim, displacement, force);
    from_ghosts();
    for (std::size_t n = 0; n < size; ++n) to[n] = force[n] * scale[n];
  };
  return largest_eigenvalue(std::move(start), dimensions, multiply, sum);
}
}  // namespace LSM

#endif
