// SPDX-License-Identifier: GPL-2.0-or-later
// The reference for the schemes of slider_cli: ordinary differential equations between the times at
// which blocks start and stop, each of which is located.
#ifndef LSM_TESTS_SWITCHING_CHAIN_H
#define LSM_TESTS_SWITCHING_CHAIN_H

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <variant>
#include <vector>

#include "scalar_chain.h"
#include "slider_chain.h"

namespace Slider {

enum class Located {
  rk4,       ///< classical Runge-Kutta of order 4 with the given step
  reference  ///< GSL's rk8pd with steps as short as its error needs
};

class SwitchingChain {
 public:
  SwitchingChain(const Parameters &p, std::vector<double> mu, Located scheme)
      : p_(p), mu_(std::move(mu)), coupling_(coupling_of(p)), n_(mu_.size()) {
    if (scheme == Located::reference)
      stepper_.reset(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2 * n_));
    ChainState s;
    s.u.assign(n_, 0.0);
    s.v = s.u;
    set_state(s);
  }
  SwitchingChain(const SwitchingChain &) = delete;
  SwitchingChain &operator=(const SwitchingChain &) = delete;

  std::int64_t step() const { return step_; }
  double time() const { return p_.dt * static_cast<double>(step_); }
  double pe() const { return pe_; }
  double dpe() const { return dpe_; }
  std::vector<double> displacements() const { return {y_.data(), y_.data() + n_}; }
  std::vector<double> velocities() const { return {y_.data() + n_, y_.data() + 2 * n_}; }

  /// Blocks with a velocity slide.
  void set_state(const ChainState &s) {
    step_ = s.step;
    y_ = s.u;
    y_.insert(y_.end(), s.v.begin(), s.v.end());
    slides_.clear();
    for (const double v : s.v) slides_.push_back(v != 0.0);
    pe_ = direct_energy(p_, s.u, p_.velocity * time());
  }

  /// Takes one time step.
  /// \throws std::runtime_error if switches do not end or the tolerance cannot be reached
  void advance() {
    const double end = p_.dt * static_cast<double>(step_ + 1);
    double t = time(), h = p_.dt;
    for (std::size_t tries = 0; t < end; ++tries) {
      if (tries > 1000 + 100 * n_) throw std::runtime_error("no end of starts and stops");
      h = std::min(h, end - t);
      if (!after(t, h, next_)) {
        h *= 0.5;
        continue;
      }
      late_.clear();
      for (std::size_t i = 0; i < n_; ++i)
        if (passed(next_, t + h, i) > 0.0) late_.push_back(i);
      if (late_.empty()) {
        y_ = next_;
        t = h < end - t ? t + h : end;
      } else if (!switch_late(t)) {
        const double high = first_switch(t, h);
        y_ = next_;
        t += high;
        switch_late(t);
      }
      h = stepper_ ? std::min(p_.dt, 2.0 * h) : p_.dt;
    }
    ++step_;
    const double pe = direct_energy(p_, displacements(), p_.velocity * time());
    dpe_ = pe - pe_;
    pe_ = pe;
  }

 private:
  double force(const double *u, std::size_t i, double t) const {
    return coupling_force(p_, coupling_, u, i) + p_.kl * (p_.velocity * t - u[i]);
  }
  /// Force on a block that slides. Stages may overshoot to v < 0 just before it stops.
  double push(const double *y, std::size_t i, double t) const {
    return force(y, i, t) - friction_of(p_.friction, mu_[i], y[n_ + i]);
  }
  /// Without inertia radiation balances all other forces.
  double velocity(const double *y, std::size_t i, double t) const {
    return p_.mass > 0.0 ? y[n_ + i] : push(y, i, t) / p_.radiation;
  }

  static int derive(double t, const double *y, double *dy, void *chain) {
    const auto &c = *static_cast<const SwitchingChain *>(chain);
    std::fill(dy, dy + 2 * c.n_, 0.0);
    for (std::size_t i = 0; i < c.n_; ++i) {
      if (!c.slides_[i]) continue;
      const double v = dy[i] = c.velocity(y, i, t);
      if (c.p_.mass > 0.0) dy[c.n_ + i] = (c.push(y, i, t) - c.p_.radiation * v) / c.p_.mass;
    }
    return GSL_SUCCESS;
  }

  /// Computes y after a time h from (t, y_) without switches.
  /// \return false if the error is too large
  bool after(double t, double h, std::vector<double> &y) {
    y = y_;
    stage_.resize(y.size());
    rate_.assign(y.size(), 0.0);
    if (stepper_) {
      gsl_odeiv2_system system{&derive, nullptr, y.size(), this};
      gsl_odeiv2_step_reset(stepper_.get());
      if (gsl_odeiv2_step_apply(stepper_.get(), t, h, y.data(), stage_.data(), nullptr, nullptr,
                                &system) != GSL_SUCCESS)
        return false;
      if (h < 1e-12) return true;
      for (std::size_t i = 0; i < y.size(); ++i)
        if (!(std::fabs(stage_[i]) <= 1e-13 * (1.0 + std::fabs(y[i])))) return false;
      return true;
    }
    constexpr double place[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0, 2.0, 2.0, 1.0};
    for (int k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < y.size(); ++i) stage_[i] = y_[i] + place[k] * h * rate_[i];
      derive(t + place[k] * h, stage_.data(), rate_.data(), this);
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6.0 * weight[k] * rate_[i];
    }
    return true;
  }

  /// Positive if block i has passed its switch: its strength while it rests, a velocity below 0
  /// while it slides.
  double passed(const std::vector<double> &y, double t, std::size_t i) const {
    return slides_[i] ? -velocity(y.data(), i, t) : force(y.data(), i, t) - mu_[i];
  }

  /// Starts or stops the late blocks that have passed their switch by now, or are held back at
  /// rest.
  bool switch_late(double t) {
    bool any = false;
    for (const std::size_t i : late_) {
      const bool held = slides_[i] && velocity(y_.data(), i, t) == 0.0;
      if (!held && !(passed(y_, t, i) > 0.0)) continue;
      any = true;
      slides_[i] = !slides_[i];
      y_[n_ + i] = 0.0;
    }
    return any;
  }

  /// Bisects for the time after t, at most h, at which the first late block has just passed its
  /// switch; next_ has y at that time.
  double first_switch(double t, double h) {
    double low = 0.0, high = h;
    std::vector<double> y;
    while (high - low > 4e-16 * std::max(1.0, t)) {
      const double at = 0.5 * (low + high);
      after(t, at, y);
      const bool past = std::any_of(late_.begin(), late_.end(),
                                    [&](std::size_t i) { return passed(y, t + at, i) > 0.0; });
      (past ? high : low) = at;
      if (past) next_.swap(y);
    }
    return high;
  }

  struct FreeStep {
    void operator()(gsl_odeiv2_step *s) const { gsl_odeiv2_step_free(s); }
  };

  Parameters p_;
  std::vector<double> mu_, coupling_, y_, next_, stage_, rate_;  // y: u, then v of every block
  std::vector<std::uint8_t> slides_;
  std::vector<std::size_t> late_;  // past their switch after a step
  std::size_t n_;
  std::int64_t step_ = 0;
  double pe_ = 0.0, dpe_ = 0.0;
  std::unique_ptr<gsl_odeiv2_step, FreeStep> stepper_;
};

/// The state of a chain at rest with given displacements (the paper has 0), the plate at 0.
inline ChainState at_rest(const Parameters &p, const std::vector<double> &u) {
  ChainState s;
  s.u = u;
  s.v.assign(u.size(), 0.0);
  LSM::NeumaierSum sum;
  for (const double x : u) sum.add(x);
  s.slip_sum = sum.sum();
  s.slip_compensation = sum.compensation();
  s.pe_sum = direct_energy(p, u, 0.0);
  return s;
}

/// A scheme of slider_cli, or one of those above.
using AnyScheme = std::variant<Scheme, Located>;

inline const char *name_of(const AnyScheme &scheme) {
  if (const auto *stepped = std::get_if<Scheme>(&scheme)) return to_string(*stepped);
  return std::get<Located>(scheme) == Located::rk4 ? "rk4" : "reference";
}

/// Calls work(chain) for a chain with the given scheme and returns its result.
template <class Work>
auto with_chain(Parameters p, std::vector<double> mu, const AnyScheme &scheme, Work &&work) {
  if (const auto *located = std::get_if<Located>(&scheme)) {
    SwitchingChain chain(p, std::move(mu), *located);
    return work(chain);
  }
  p.scheme = std::get<Scheme>(scheme);
  Chain chain(p, mu, false);
  return work(chain);
}

}  // namespace Slider

#endif
