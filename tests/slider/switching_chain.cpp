// SPDX-License-Identifier: GPL-2.0-or-later
#include "switching_chain.h"

#include <gsl/gsl_errno.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace Slider {

namespace {

std::ptrdiff_t offset(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }

}  // namespace

SwitchingChain::SwitchingChain(const Parameters &p, std::vector<double> mu, Located scheme)
    : p_(p), scheme_(scheme), mu_(std::move(mu)), coupling_(coupling_of(p)) {
  n_ = mu_.size();
  y_.assign(2 * n_ + 1, 0.0);
  slides_.assign(n_, 0);
  if (scheme == Located::reference) {
    system_ = {&SwitchingChain::derivative, nullptr, 2 * n_ + 1, this};
    stepper_.reset(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2 * n_ + 1));
    if (!stepper_) throw std::runtime_error("out of memory for the reference scheme");
    error_.assign(2 * n_ + 1, 0.0);
    inner_ = p.dt;
  }
}

double SwitchingChain::slip_sum() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; ++i) sum += y_[i];
  return sum;
}

std::vector<double> SwitchingChain::displacements() const {
  return {y_.begin(), y_.begin() + offset(n_)};
}

std::vector<double> SwitchingChain::velocities() const {
  return {y_.begin() + offset(n_), y_.begin() + offset(2 * n_)};
}

void SwitchingChain::set_state(const ChainState &s) {
  step_ = s.step;
  pe_ = pe_start_ = s.pe_sum;
  std::copy(s.u.begin(), s.u.end(), y_.begin());
  std::copy(s.v.begin(), s.v.end(), y_.begin() + offset(n_));
  for (std::size_t i = 0; i < n_; ++i) slides_[i] = s.v[i] != 0.0;
}

EnergyLedger SwitchingChain::ledger() const {
  EnergyLedger l;
  l.friction = y_[2 * n_];
  for (std::size_t i = 0; i < n_; ++i) l.kinetic += 0.5 * p_.mass * y_[n_ + i] * y_[n_ + i];
  l.plate = pe_ - pe_start_ + l.kinetic + l.friction;
  return l;
}

void SwitchingChain::set_displacements(const std::vector<double> &u) {
  std::copy(u.begin(), u.end(), y_.begin());
  pe_ = pe_start_ = direct_energy(p_, u, time() * p_.velocity);
}

void SwitchingChain::advance() {
  const double end = p_.dt * static_cast<double>(step_ + 1);
  const std::vector<double> before = y_;
  double t = time();
  // Blocks beyond their limit in a state set from outside start at once.
  std::int64_t here = 0;
  const std::int64_t most = 1000 + 100 * static_cast<std::int64_t>(n_);
  while (t < end) {
    const double h = scheme_ == Located::reference ? std::min(inner_, end - t) : end - t;
    const double taken = advance_to_switch(t, h);
    const bool done = taken >= end - t;
    t = done ? end : t + taken;
    if (++here > most)
      throw std::runtime_error("more than " + std::to_string(most) +
                               " stick/slip switches within step " + std::to_string(step_));
  }
  ++step_;
  const double x0 = p_.velocity * p_.dt * static_cast<double>(step_ - 1),
               x1 = p_.velocity * p_.dt * static_cast<double>(step_);
  // The change of a quadratic energy is the mean force times the change of each coordinate.
  double change = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    change -= 0.5 * (force(before.data(), i, x0) + force(y_.data(), i, x1)) * (y_[i] - before[i]);
    change += 0.5 * p_.kl * ((x0 - before[i]) + (x1 - y_[i])) * (x1 - x0);
  }
  dpe_ = change;
  pe_ += change;
}

double SwitchingChain::force(const double *u, std::size_t i, double plate) const {
  return coupling_force(p_, coupling_, u, i) + p_.kl * (plate - u[i]);
}

void SwitchingChain::derive(double t, const double *y, double *dy) const {
  const double plate = p_.velocity * t;
  double loss = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double v = y[n_ + i];
    if (slides_[i]) {
      // Stages may overshoot to v < 0 just before the block sticks; the law continues smoothly.
      const double friction = friction_of(p_.friction, mu_[i], v);
      dy[i] = v;
      dy[n_ + i] = (force(y, i, plate) - friction - p_.radiation * v) / p_.mass;
      loss += friction * v;
    } else {
      dy[i] = dy[n_ + i] = 0.0;
    }
  }
  dy[2 * n_] = loss;
}

int SwitchingChain::derivative(double t, const double *y, double *dy, void *self) {
  static_cast<const SwitchingChain *>(self)->derive(t, y, dy);
  return GSL_SUCCESS;
}

/// Computes y after a time h from (t, y_) without switches.
/// \return false if the error estimate is too large
bool SwitchingChain::propagate(double t, double h, std::vector<double> &out) {
  out = y_;
  if (scheme_ == Located::reference) {
    gsl_odeiv2_step_reset(stepper_.get());
    if (gsl_odeiv2_step_apply(stepper_.get(), t, h, out.data(), error_.data(), nullptr, nullptr,
                              &system_) != GSL_SUCCESS)
      return false;
    for (std::size_t i = 0; i < 2 * n_; ++i)
      if (!(std::fabs(error_[i]) <= 1e-13 * (1.0 + std::fabs(out[i])))) return false;
    return true;
  }
  const std::size_t n = out.size();
  for (auto *k : {&k1_, &k2_, &k3_, &k4_, &stage_}) k->resize(n);
  derive(t, y_.data(), k1_.data());
  for (std::size_t i = 0; i < n; ++i) stage_[i] = y_[i] + 0.5 * h * k1_[i];
  derive(t + 0.5 * h, stage_.data(), k2_.data());
  for (std::size_t i = 0; i < n; ++i) stage_[i] = y_[i] + 0.5 * h * k2_[i];
  derive(t + 0.5 * h, stage_.data(), k3_.data());
  for (std::size_t i = 0; i < n; ++i) stage_[i] = y_[i] + h * k3_[i];
  derive(t + h, stage_.data(), k4_.data());
  for (std::size_t i = 0; i < n; ++i)
    out[i] = y_[i] + h / 6.0 * (k1_[i] + 2.0 * (k2_[i] + k3_[i]) + k4_[i]);
  return true;
}

/// Positive if block i has passed its switch: friction is overcome while at rest, v < 0 while
/// sliding.
double SwitchingChain::passed(const std::vector<double> &y, double t, std::size_t i) const {
  if (slides_[i]) return -y[n_ + i];
  return force(y.data(), i, p_.velocity * t) - mu_[i];
}

void SwitchingChain::flip(std::size_t i) {
  slides_[i] = !slides_[i];
  y_[n_ + i] = 0.0;
}

/// Advances by at most h, or to the first switch within this time.
/// \return time advanced
double SwitchingChain::advance_to_switch(double t, double h) {
  for (;;) {
    if (propagate(t, h, trial_)) break;
    h *= 0.5;
    if (h < 1e-12) throw std::runtime_error("the reference scheme cannot reach its tolerance");
  }
  if (scheme_ == Located::reference) inner_ = std::min(p_.dt, 2.0 * h);
  double high = h;
  std::vector<std::size_t> &late = late_;
  late.clear();
  for (std::size_t i = 0; i < n_; ++i)
    if (passed(trial_, t + h, i) > 0.0) late.push_back(i);
  if (late.empty()) {
    y_ = trial_;
    return h;
  }
  // Handles blocks that are past their switch (or at rest and held back) at the start already.
  bool at_once = false;
  for (std::size_t i : late) {
    const double now = passed(y_, t, i);
    if (now > 0.0 || (slides_[i] && y_[n_ + i] == 0.0)) {
      flip(i);
      at_once = true;
    }
  }
  if (at_once) return 0.0;
  // Bracket the earliest switch: the upper end is a time at which some block is late. It is found
  // by regula falsi (Illinois variant) for the block that is latest, with bisection as a safeguard.
  double low = 0.0;
  std::size_t who = late.front();
  auto latest = [&](const std::vector<double> &y, double at, std::size_t &which) {
    bool any = false;
    double worst = 0.0;
    for (std::size_t i : late) {
      const double g = passed(y, at, i);
      if (g > 0.0 && (!any || g > worst)) {
        any = true;
        worst = g;
        which = i;
      }
    }
    return any;
  };
  const double resolution = 4e-16 * std::max(1.0, std::fabs(t));
  for (int k = 0; k < 200 && high - low > resolution; ++k) {
    double mid = 0.5 * (low + high);
    if (k % 3 != 2) {  // secant on the block that is late, between the bracket's ends
      latest(trial_, t + high, who);
      if (low > 0.0) propagate(t, low, middle_);
      const double g_low = passed(low > 0.0 ? middle_ : y_, t + low, who);
      const double g_high = passed(trial_, t + high, who);
      const double guess = low + (high - low) * (-g_low) / (g_high - g_low);
      // Alternate sides so that both ends close in.
      const double nudge = (k % 3 == 0 ? 1.0 : -1.0) * std::max(resolution, 1e-6 * (high - low));
      if (guess + nudge > low && guess + nudge < high) mid = guess + nudge;
    }
    propagate(t, mid, middle_);
    std::size_t which = who;
    if (latest(middle_, t + mid, which)) {
      high = mid;
      trial_.swap(middle_);
      who = which;
    } else {
      low = mid;
    }
  }
  const std::vector<double> &found = trial_;
  y_ = found;
  for (std::size_t i : late)
    if (passed(found, t + high, i) > 0.0) flip(i);
  return high;
}

}  // namespace Slider
