// SPDX-License-Identifier: GPL-2.0-or-later
// Schemes with which those of slider_cli are compared: those that locate every change between stick
// and slip in time, and semi-implicit Euler.
#ifndef LSM_TESTS_SWITCHING_CHAIN_H
#define LSM_TESTS_SWITCHING_CHAIN_H

#include <gsl/gsl_odeiv2.h>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "scalar_chain.h"
#include "slider_chain.h"
#include "slider_parameters.h"

namespace Slider {

enum class Located {
  rk4,       ///< classical Runge-Kutta of order 4 with the given step
  reference  ///< GSL's adaptive rk8pd
};

/// The chain as ordinary differential equations between switches. State: u, v of every block, then
/// the friction loss (for the ledger).
class SwitchingChain {
 public:
  SwitchingChain(const Parameters &p, std::vector<double> mu, Located scheme);

  std::int64_t step() const { return step_; }
  double pe() const { return pe_; }
  double dpe() const { return dpe_; }
  double slip_sum() const;
  std::vector<double> displacements() const;
  std::vector<double> velocities() const;

  /// Sets the state; blocks with a velocity slide.
  void set_state(const ChainState &s);

  EnergyLedger ledger() const;
  void set_displacements(const std::vector<double> &u);
  double time() const { return p_.dt * static_cast<double>(step_); }
  /// Takes one time step.
  /// \throws std::runtime_error if switches do not end or the tolerance cannot be reached
  void advance();

 private:
  double force(const double *u, std::size_t i, double plate) const;
  void derive(double t, const double *y, double *dy) const;
  static int derivative(double t, const double *y, double *dy, void *self);
  bool propagate(double t, double h, std::vector<double> &out);
  double passed(const std::vector<double> &y, double t, std::size_t i) const;
  void flip(std::size_t i);
  double advance_to_switch(double t, double h);

  struct FreeStep {
    void operator()(gsl_odeiv2_step *s) const { gsl_odeiv2_step_free(s); }
  };

  Parameters p_;
  Located scheme_;
  std::vector<double> mu_, coupling_;
  std::vector<double> y_;  // u, v of every block, then the friction loss
  std::vector<double> trial_, middle_, error_;
  std::vector<double> k1_, k2_, k3_, k4_, stage_;
  std::vector<std::uint8_t> slides_;
  std::vector<std::size_t> late_;
  std::size_t n_ = 0;
  std::int64_t step_ = 0;
  double pe_ = 0.0, dpe_ = 0.0, pe_start_ = 0.0, inner_ = 0.0;
  gsl_odeiv2_system system_{};
  std::unique_ptr<gsl_odeiv2_step, FreeStep> stepper_;
};

/// A chain of slider_cli that starts from given displacements (the paper has 0), at rest.
class StartedChain : public Chain {
 public:
  StartedChain(const Parameters &p, const std::vector<double> &mu) : Chain(p, mu, false), p_(p) {}

  void set_displacements(const std::vector<double> &u) {
    ChainState s;
    s.u = u;
    s.v.assign(u.size(), 0.0);
    LSM::NeumaierSum sum;
    for (double x : u) sum.add(x);
    s.slip_sum = sum.sum();
    s.slip_compensation = sum.compensation();
    s.pe_sum = direct_energy(p_, u, 0.0);
    set_state(s);
  }

 private:
  Parameters p_;
};

/// Semi-implicit Euler, in the plain loop over all blocks.
struct Euler {
  bool operator==(const Euler &) const { return true; }
};

/// A scheme of slider_cli, or one of those above.
using AnyScheme = std::variant<Scheme, Located, Euler>;

inline const char *name_of(const AnyScheme &scheme) {
  if (const auto *stepped = std::get_if<Scheme>(&scheme)) return to_string(*stepped);
  if (std::holds_alternative<Euler>(scheme)) return "semi-implicit";
  return std::get<Located>(scheme) == Located::rk4 ? "rk4" : "reference";
}

/// Calls work(chain) for a chain with the given scheme and returns its result.
template <class Work>
auto with_chain(Parameters p, std::vector<double> mu, const AnyScheme &scheme, Work &&work) {
  if (const auto *located = std::get_if<Located>(&scheme)) {
    SwitchingChain chain(p, std::move(mu), *located);
    return work(chain);
  }
  if (std::holds_alternative<Euler>(scheme)) {
    ScalarChain chain(p, std::move(mu), false, true);
    return work(chain);
  }
  p.scheme = std::get<Scheme>(scheme);
  StartedChain chain(p, mu);
  return work(chain);
}

}  // namespace Slider

#endif
