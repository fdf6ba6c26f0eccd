// SPDX-License-Identifier: GPL-2.0-or-later
// The straightforward loop over all blocks, one after the other, PE summed directly every step:
// what the paper describes, and the yardstick for the chain of slider_cli and, with the ledger, for
// energy.
#ifndef LSM_TESTS_SCALAR_CHAIN_H
#define LSM_TESTS_SCALAR_CHAIN_H

#include <cmath>
#include <cstdint>
#include <vector>

#include "slider_chain.h"
#include "slider_parameters.h"

namespace Slider {

/// Friction of a block that moves, or starts to, after the given slip.
inline double friction_of(const Friction &law, double mu, double v, double slip) {
  switch (law.law) {
    case Law::velocity_weakening:
      return LSM::VelocityWeakening::friction(mu, v);
    case Law::coulomb:
      return law.dynamic * mu;
    case Law::slip_weakening:
      return LSM::SlipWeakening::strength(mu, law.dynamic * mu, law.dc, slip);
  }
  return mu;
}

/// Work done and lost since the start: plate = PE + kinetic + friction up to the scheme's error.
struct EnergyLedger {
  double plate = 0.0, friction = 0.0, kinetic = 0.0;
};

class ScalarChain {
 public:
  ScalarChain(const Parameters &p, std::vector<double> mu, bool ledger = false)
      : p_(p), mu_(std::move(mu)), keep_ledger_(ledger) {
    u_.assign(mu_.size(), 0.0);
    v_ = u_;
    force_ = u_;
    rest_ = u_;
  }

  std::int64_t step() const { return step_; }
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
    rest_ = s.rest.empty() ? u_ : s.rest;
    set_forces();
    pe_ = s.pe_sum;
    dpe_ = s.dpe;
  }

  void set_displacements(const std::vector<double> &u) {
    u_ = u;
    rest_ = u_;
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
    const double h_m = h / p_.mass, half_m = half / p_.mass;
    for (std::size_t i = 0; i < n; ++i) {
      double v = v_[i];
      if (v == 0.0 && force_[i] <= mu_[i]) continue;  // stuck
      const double push = force_[i] - friction_of(law, mu_[i], v, u_[i] - rest_[i]);
      if (p_.scheme == Scheme::verlet)
        v += half_m * push;
      else
        v += h_m * push;
      if (v < 0.0) v = 0.0;  // no back-slip
      u_[i] += p_.scheme == Scheme::printed ? half * (v_[i] + v) : h * v;
      v_[i] = v;
    }
    ++step_;
    const double pe = set_forces();
    if (p_.scheme == Scheme::verlet && law.law != Law::velocity_weakening) {
      for (std::size_t i = 0; i < n; ++i) {
        if (v_[i] == 0.0 && force_[i] <= mu_[i]) continue;
        // A block that came to rest in the first half of the step has healed.
        const double slip = v_[i] > 0.0 ? u_[i] - rest_[i] : 0.0;
        v_[i] =
            std::fmax(0.0, v_[i] + half_m * (force_[i] - friction_of(law, mu_[i], v_[i], slip)));
      }
    } else if (p_.scheme == Scheme::verlet) {
      for (std::size_t i = 0; i < n; ++i) {
        const double c = v_[i] + half_m * force_[i], b = half_m * mu_[i];
        const double q = (1.0 + c) * (1.0 + c) - 4.0 * b;
        if (c <= b && c <= 1.0) {
          v_[i] = 0.0;
        } else if (q <= 0.0) {
          v_[i] = 0.0;
        } else {
          const double s = std::sqrt(q);
          const double w = c > 1.0 ? ((c - 1.0) + s) / 2.0 : 2.0 * (c - b) / ((1.0 - c) + s);
          v_[i] = w > 0.0 ? w : 0.0;
        }
      }
    }
    dpe_ = pe - pe_;
    pe_ = pe;
    if (keep_ledger_) balance(old_plate);
    if (law.needs_rest())
      for (std::size_t i = 0; i < n; ++i)
        if (v_[i] == 0.0) rest_[i] = u_[i];
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
      ledger_.friction += 0.5 * slip *
                          (friction_of(law, mu_[i], saved_v_[i], saved_u_[i] - rest_[i]) +
                           friction_of(law, mu_[i], v_[i], u_[i] - rest_[i]));
      ledger_.kinetic += 0.5 * p_.mass * v_[i] * v_[i];
    }
  }

  /// Forces of all springs; returns PE.
  double set_forces() {
    const std::size_t n = u_.size();
    const double x = plate(), kc = p_.kc, kl = p_.kl;
    const double *u = u_.data();
    double *force = force_.data();
    double coupling = 0.0, leaves = 0.0;
    auto one = [&](std::size_t i, double left, double right) {
      const double stretch = right - u[i], leaf = x - u[i];
      force[i] = kc * ((left - u[i]) + stretch) + kl * leaf;
      coupling += stretch * stretch;
      leaves += leaf * leaf;
    };
    if (n == 1) {
      one(0, u[0], u[0]);
    } else {
      one(0, u[n - 1], u[1]);
      for (std::size_t i = 1; i + 1 < n; ++i) one(i, u[i - 1], u[i + 1]);
      one(n - 1, u[n - 2], u[0]);
    }
    return 0.5 * (kc * coupling + kl * leaves);
  }

  Parameters p_;
  std::vector<double> mu_, u_, v_, force_, rest_, saved_u_, saved_v_;
  bool keep_ledger_;
  EnergyLedger ledger_;
  std::int64_t step_ = 0;
  double pe_ = 0.0, dpe_ = 0.0;
};

}  // namespace Slider

#endif
