// SPDX-License-Identifier: GPL-2.0-or-later
// The straightforward implementation of what the paper describes: a loop over all blocks, one after
// the other, or over all pairs of blocks that modes couple, with PE summed directly in every step.
// It is the reference for the chain of slider_cli and, with the ledger, for energy.
#ifndef LSM_TESTS_SCALAR_CHAIN_H
#define LSM_TESTS_SCALAR_CHAIN_H

#include <cmath>
#include <cstdint>
#include <vector>

#include "slider_chain.h"
#include "slider_parameters.h"

namespace Slider {

/// Friction of a block that moves, or starts to move.
inline double friction_of(const Friction &law, double mu, double v) {
  switch (law.law) {
    case Law::velocity_weakening:
      return LSM::VelocityWeakening::friction(mu, v);
    case Law::coulomb:
      return law.dynamic * mu;
  }
  return mu;
}

/// Work done and lost since the start: plate = PE + kinetic + friction + radiated, up to the error
/// of the scheme.
struct EnergyLedger {
  double plate = 0.0, friction = 0.0, kinetic = 0.0, radiated = 0.0;
};

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
  /// \param euler the scheme is semi-implicit Euler, v += h a, x += h v, with which those of
  /// slider_cli are compared
  ScalarChain(const Parameters &p, std::vector<double> mu, bool ledger = false, bool euler = false)
      : p_(p),
        mu_(std::move(mu)),
        coupling_(coupling_of(p)),
        printed_(p.scheme == Scheme::printed && !euler),
        verlet_(p.scheme == Scheme::verlet && !euler),
        keep_ledger_(ledger) {
    u_.assign(mu_.size(), 0.0);
    v_ = u_;
    force_ = u_;
    ahead_ = u_;
  }

  std::int64_t step() const { return step_; }
  double time() const { return p_.dt * static_cast<double>(step_); }
  double plate() const { return p_.velocity * p_.dt * static_cast<double>(step_); }
  double pe() const { return pe_; }
  double dpe() const { return dpe_; }
  double slip_sum() const {
    double sum = 0.0;
    for (double x : u_) sum += x;
    return sum;
  }
  std::vector<double> displacements() const { return u_; }
  std::vector<double> velocities() const { return v_; }
  const EnergyLedger &ledger() const { return ledger_; }

  void set_state(const ChainState &s) {
    step_ = s.step;
    u_ = s.u;
    v_ = s.v;
    ahead_ = s.ahead;
    if (ahead_.empty())
      for (double v : v_) ahead_.push_back(p_.dt * v);
    set_forces();
    pe_ = s.pe_sum;
    dpe_ = s.dpe;
  }

  void set_displacements(const std::vector<double> &u) {
    u_ = u;
    pe_ = set_forces();
  }

  void advance() {
    const std::size_t n = u_.size();
    const double h = p_.dt, half = 0.5 * h;
    const double old_plate = plate();
    const Friction &law = p_.friction;
    if (keep_ledger_) {
      saved_u_ = u_;
      saved_v_ = v_;
    }
    const double h_m = h / p_.mass, half_m = half / p_.mass, eta = p_.radiation;
    const double slower = 1.0 / (1.0 + half_m * eta);
    const bool balances = p_.scheme == Scheme::adams_bashforth;
    if (balances) {
      old_force_ = force_;
      old_u_ = u_;
    }
    for (std::size_t i = 0; i < n; ++i) {
      double v = v_[i];
      if (balances) {
        u_[i] += std::fabs(ahead_[i]);
        continue;
      }
      if (v == 0.0 && force_[i] <= mu_[i]) continue;  // stuck
      const double push = force_[i] - friction_of(law, mu_[i], v) - eta * v;
      if (verlet_)
        v += half_m * push;
      else
        v += h_m * push;
      if (v < 0.0) v = 0.0;  // no back-slip
      u_[i] += printed_ ? half * (v_[i] + v) : h * v;
      v_[i] = v;
    }
    ++step_;
    const double pe = set_forces();
    if (balances) {
      for (std::size_t i = 0; i < n; ++i) balance_forces(i);
    } else if (verlet_ && law.law != Law::velocity_weakening) {
      for (std::size_t i = 0; i < n; ++i) {
        if (v_[i] == 0.0 && force_[i] <= mu_[i]) continue;
        v_[i] = std::fmax(
            0.0, (v_[i] + half_m * (force_[i] - friction_of(law, mu_[i], v_[i]))) * slower);
      }
    } else if (verlet_) {
      for (std::size_t i = 0; i < n; ++i)
        v_[i] = larger_root((v_[i] + half_m * force_[i]) * slower, half_m * mu_[i] * slower);
    }
    dpe_ = pe - pe_;
    pe_ = pe;
    if (keep_ledger_) balance(old_plate);
  }

 private:
  void balance(double old_plate) {
    const std::size_t n = u_.size();
    const Friction &law = p_.friction;
    const double plate_now = plate();
    ledger_.kinetic = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double slip = u_[i] - saved_u_[i];
      ledger_.plate +=
          p_.kl * 0.5 * ((old_plate - saved_u_[i]) + (plate_now - u_[i])) * (plate_now - old_plate);
      ledger_.friction +=
          0.5 * slip * (friction_of(law, mu_[i], saved_v_[i]) + friction_of(law, mu_[i], v_[i]));
      const bool stopped = p_.scheme == Scheme::adams_bashforth && v_[i] == 0.0;
      ledger_.radiated +=
          0.5 * slip * p_.radiation * (saved_v_[i] + (stopped ? saved_v_[i] : v_[i]));
      ledger_.kinetic += 0.5 * p_.mass * v_[i] * v_[i];
    }
  }

  // Without inertia: computes the velocity at the end of a step, and the slip in the next step for
  // a force that continues to change at the same rate, from the time at which the block should have
  // started to that at which it will stop.
  void balance_forces(std::size_t i) {
    const double moved = u_[i] - old_u_[i];
    const double mu = mu_[i], f = force_[i], mobility = 1.0 / p_.radiation;
    const bool slides = v_[i] > 0.0 && ahead_[i] >= 0.0;
    v_[i] = ahead_[i] = 0.0;
    if (!slides && f <= mu_[i]) return;
    const double next = slides ? f + (f - old_force_[i]) : f;
    double part = 1.0, mean = 0.0, v = 0.0;
    bool stops = false;
    if (p_.friction.law == Law::velocity_weakening) {
      const double b = mobility * mu, slowest = std::fmax(0.0, std::sqrt(b) - 1.0);
      v = larger_root(mobility * f, b);
      const double own = p_.dt * stiffness_, others = (f - old_force_[i]) + stiffness_ * moved;
      // Time per velocity, or force, integrated over the velocity.
      double p[3], sum = 0.0, sum_v = 0.0, last = slowest;
      const auto integrate = [&](bool time) {
        const double w[] = {v, 0.5 * (v + last), last};
        bool falls = true;
        for (int k = 0; k < 3; ++k) {
          const double fall = time ? own * w[k] - others : 1.0;
          falls = falls && fall > 0.0;
          p[k] = (k == 1 ? 4.0 : 1.0) * std::fmax(0.0, 1.0 - b / ((1.0 + w[k]) * (1.0 + w[k])));
          p[k] /= fall;
        }
        sum = (p[0] + p[1]) + p[2];
        sum_v = (p[0] * w[0] + p[1] * w[1]) + p[2] * w[2];
        return falls;
      };
      const bool falls = integrate(true);
      const double until = (p_.radiation / 6.0) * (v - slowest) * sum;
      stops = slides && falls && until < 1.0;
      if (stops) {
        part = until;
      } else {
        last = std::fmax(slowest, larger_root(mobility * next, b));
        integrate(false);
      }
      mean = sum > 0.0 ? sum_v / sum : 0.5 * (v + last);
    } else {
      v = std::fmax(0.0, mobility * (f - friction_of(p_.friction, mu, v)));
      const double last = mobility * (next - friction_of(p_.friction, mu, v));
      stops = last < 0.0;
      if (stops) part = v / (v - last);
      mean = stops ? 0.5 * v : 0.5 * (v + last);
    }
    if (!(v > 0.0)) return;
    v_[i] = v;
    const double late = slides ? 0.0 : old_force_[i] < mu ? (f - mu) / (f - old_force_[i]) : 1.0;
    ahead_[i] = p_.dt * (part * mean + late * v) * (stops ? -1.0 : 1.0);
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
    const double x = plate();
    double coupling = 0.0, leaves = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double others = coupling_force(p_, coupling_, u_.data(), i), leaf = x - u_[i];
      force_[i] = others + p_.kl * leaf;
      if (p_.by_springs()) {
        const double stretch = u_[i + 1 < n ? i + 1 : 0] - u_[i];
        coupling += p_.kc * stretch * stretch;
      } else {
        coupling -= (u_[i] - u_[0]) * others;
      }
      leaves += p_.kl * leaf * leaf;
    }
    return 0.5 * (coupling + leaves);
  }

  Parameters p_;
  std::vector<double> mu_, coupling_, u_, v_, force_, ahead_, old_u_, old_force_;
  std::vector<double> saved_u_, saved_v_;
  bool printed_, verlet_;  // the scheme; neither: Euler, or without inertia
  bool keep_ledger_;
  double stiffness_ = stiffness_alone(p_);
  EnergyLedger ledger_;
  std::int64_t step_ = 0;
  double pe_ = 0.0, dpe_ = 0.0;
};

}  // namespace Slider

#endif
