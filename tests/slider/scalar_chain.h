// SPDX-License-Identifier: GPL-2.0-or-later
// The straightforward implementation of what the paper describes: a loop over all blocks, one after
// the other, or over all pairs of blocks that modes couple, with PE summed directly in every step.
#ifndef LSM_TESTS_SCALAR_CHAIN_H
#define LSM_TESTS_SCALAR_CHAIN_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "slider_parameters.h"

namespace Slider {

/// Friction of a block that moves, or starts to move.
inline double friction_of(const Friction &law, double mu, double v) {
  return law.law == Law::coulomb ? law.dynamic * mu : LSM::VelocityWeakening::friction(mu, v);
}

/// The coupling of blocks i and i + d by modes, C_d: the cosine series of K less its mean, that of
/// mode 0.
inline std::vector<double> coupling_of(const Parameters &p) {
  const int n = p.blocks;
  std::vector<double> c(static_cast<std::size_t>(p.by_springs() ? 0 : n), 0.0);
  for (int d = 0; d < static_cast<int>(c.size()); ++d)
    for (int mode = 0; mode < n; ++mode) {
      const auto k = static_cast<std::size_t>(std::min(mode, n - mode));
      const std::int64_t turn = static_cast<std::int64_t>(mode) * d % n;
      c[static_cast<std::size_t>(d)] +=
          (p.modes[k] - p.modes[0]) * std::cos(2.0 * LSM::pi * static_cast<double>(turn) / n) / n;
    }
  return c;
}

/// Force of all other blocks on a block: by springs or, summed over all pairs, by modes.
inline double coupling_force(const Parameters &p, const std::vector<double> &c, const double *u,
                             std::size_t i) {
  const auto n = static_cast<std::size_t>(p.blocks);
  if (p.by_springs())
    return p.kc * ((u[i > 0 ? i - 1 : n - 1] - u[i]) + (u[i + 1 < n ? i + 1 : 0] - u[i]));
  double force = 0.0;
  for (std::size_t j = 0; j < n; ++j) force -= c[(n + j - i) % n] * (u[j] - u[i]);
  return force;
}

class ScalarChain {
 public:
  ScalarChain(const Parameters &p, std::vector<double> mu)
      : p_(p), mu_(std::move(mu)), coupling_(coupling_of(p)) {
    for (auto *array : {&u_, &v_, &force_, &old_force_, &ahead_}) array->assign(mu_.size(), 0.0);
  }

  std::int64_t step() const { return step_; }
  double pe() const { return pe_; }
  double dpe() const { return dpe_; }
  const std::vector<double> &displacements() const { return u_; }

  void advance() {
    old_force_ = force_;
    for (std::size_t i = 0; i < u_.size(); ++i) move(i);
    ++step_;
    const double pe = set_forces();
    for (std::size_t i = 0; i < u_.size(); ++i) pull(i);
    dpe_ = pe - pe_;
    pe_ = pe;
  }

 private:
  double push(std::size_t i) const { return force_[i] - friction_of(p_.friction, mu_[i], v_[i]); }
  bool rests(std::size_t i) const { return v_[i] == 0.0 && force_[i] <= mu_[i]; }

  void move(std::size_t i) {
    const double h = p_.dt, v = v_[i];
    const bool printed = p_.scheme == Scheme::printed;
    if (p_.scheme == Scheme::adams_bashforth) {
      u_[i] += std::fabs(ahead_[i]);
    } else if (!rests(i)) {
      const double by_mass = (printed ? h : 0.5 * h) / p_.mass;
      v_[i] = std::fmax(0.0, v + by_mass * (push(i) - p_.radiation * v));  // no back-slip
      u_[i] += printed ? 0.5 * h * (v + v_[i]) : h * v_[i];
    }
  }

  void pull(std::size_t i) {
    if (p_.scheme == Scheme::adams_bashforth) return balance(i);
    if (p_.scheme == Scheme::printed) return;
    const double half_m = 0.5 * p_.dt / p_.mass, slower = 1.0 / (1.0 + half_m * p_.radiation);
    if (p_.friction.law == Law::velocity_weakening)
      v_[i] = larger_root((v_[i] + half_m * force_[i]) * slower, half_m * mu_[i] * slower);
    else if (!rests(i))
      v_[i] = std::fmax(0.0, (v_[i] + half_m * push(i)) * slower);
  }

  // Without inertia: computes the velocity at the end of a step, and the slip in the next step for
  // a force that continues to change at the same rate, from the time at which the block should have
  // started to that at which it will stop.
  void balance(std::size_t i) {
    const double mu = mu_[i], f = force_[i], old = old_force_[i], mobility = 1.0 / p_.radiation;
    const bool slides = v_[i] > 0.0 && ahead_[i] >= 0.0;
    v_[i] = ahead_[i] = 0.0;
    if (!slides && f <= mu) return;
    const double next = slides ? f + (f - old) : f, friction = p_.friction.dynamic * mu;
    const double v = std::fmax(0.0, mobility * (f - friction)), last = mobility * (next - friction);
    if (!(v > 0.0)) return;
    v_[i] = v;
    const double late = slides ? 0.0 : old < mu ? (f - mu) / (f - old) : 1.0;
    if (last < 0.0)
      ahead_[i] = -p_.dt * (v / (v - last) * (0.5 * v) + late * v);
    else
      ahead_[i] = p_.dt * (0.5 * (v + last) + late * v);
  }

  /// The larger root of w = c - b / (1 + w) if it is positive, else 0.
  static double larger_root(double c, double b) {
    const double q = (1.0 + c) * (1.0 + c) - 4.0 * b;
    if ((c <= b && c <= 1.0) || q <= 0.0) return 0.0;
    const double s = std::sqrt(q);
    const double w = c > 1.0 ? ((c - 1.0) + s) / 2.0 : 2.0 * (c - b) / ((1.0 - c) + s);
    return w > 0.0 ? w : 0.0;
  }

  /// Computes the forces of all springs.
  /// \return PE
  double set_forces() {
    const std::size_t n = u_.size();
    const double plate = p_.velocity * p_.dt * static_cast<double>(step_);
    double coupling = 0.0, leaves = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double others = coupling_force(p_, coupling_, u_.data(), i), leaf = plate - u_[i];
      force_[i] = others + p_.kl * leaf;
      const double stretch = u_[i + 1 < n ? i + 1 : 0] - u_[i];
      coupling += p_.by_springs() ? p_.kc * stretch * stretch : (u_[0] - u_[i]) * others;
      leaves += p_.kl * leaf * leaf;
    }
    return 0.5 * (coupling + leaves);
  }

  Parameters p_;
  std::vector<double> mu_, coupling_, u_, v_, force_, old_force_, ahead_;
  std::int64_t step_ = 0;
  double pe_ = 0.0, dpe_ = 0.0;
};

}  // namespace Slider

#endif
