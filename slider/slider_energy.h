// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_energy.h
/// The potential energy (PE) of all springs of a chain,
///   PE = sum_i K_c/2 (U_{i+1} - U_i)^2 + K_l/2 (X - U_i)^2,
/// or of modes, sum_ij U_i C_ij U_j / 2 in place of the springs K_c, and the sum of all
/// displacements. PE is quadratic, so its change over a step is exactly minus the work of the mean
/// spring force on the blocks plus that of the mean plate force on the plate; only moving blocks
/// enter †.
#ifndef SLIDER_ENERGY_H
#define SLIDER_ENERGY_H

#include <cstdint>
#include <vector>

#include "numerics/sum.h"
#include "slider_kernels.h"
#include "slider_modes.h"
#include "slider_parameters.h"

namespace Slider {

/// The state from which a run continues.
struct ChainState {
  std::int64_t step = 0;
  double slip_sum = 0.0, slip_compensation = 0.0;  ///< sum of all U_i
  double pe_sum = 0.0, pe_compensation = 0.0;
  std::int64_t quiet_since = -1;  ///< step since which no block has moved; -1: one moves
  double pe_anchor = 0.0, loading_anchor = 0.0;  ///< PE and sum (X - U_i) at quiet_since
  std::int64_t moved = 0;  ///< steps in which a block moved, summed over blocks
  double dpe = 0.0;        ///< change of PE over the last step
  std::vector<double> u, v;
  /// Slips in the next step, for the scheme without inertia; empty: from the present velocities.
  std::vector<double> ahead;

  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.step, self.slip_sum, self.slip_compensation, self.pe_sum, self.pe_compensation,
          self.quiet_since, self.pe_anchor, self.loading_anchor, self.moved, self.dpe);
    for (auto *values : {&self.u, &self.v, &self.ahead}) state.list(*values);
  }
};

/// PE of all springs, summed directly: the initial value of PeAccount, and a check of its later
/// ones.
inline double direct_energy(const Parameters &p, const std::vector<double> &u, double plate) {
  LSM::NeumaierSum sum;
  if (const auto forces = mode_forces(p)) {
    const double *const coupling = forces->find(u.data());
    for (std::size_t i = 0; i < u.size(); ++i) {
      sum.add(0.5 * p.kl * (plate - u[i]) * (plate - u[i]));
      // As the forces add up to zero, u[0] may be subtracted.
      sum.add(-0.5 * (u[i] - u[0]) * coupling[i]);
    }
    return sum.value();
  }
  for (int i = 0; i < p.blocks; ++i) {
    const double stretch =
        u[static_cast<std::size_t>(i + 1 < p.blocks ? i + 1 : 0)] - u[static_cast<std::size_t>(i)];
    const double leaf = plate - u[static_cast<std::size_t>(i)];
    sum.add(0.5 * p.kc * stretch * stretch + 0.5 * p.kl * leaf * leaf);
  }
  return sum.value();
}

/// Keeps PE up to date step by step.
class PeAccount {
 public:
  explicit PeAccount(const Parameters &p)
      : kl_(p.kl), plate_step_(p.velocity * p.dt), blocks_(static_cast<double>(p.blocks)) {}

  double value() const { return value_; }
  double change() const { return change_; }          ///< over the last step
  double slip_sum() const { return slip_.value(); }  ///< sum of all displacements
  /// Whether nothing moves at present.
  bool quiet() const { return quiet_since_ >= 0; }
  /// Change over a quiet step that starts at the given step.
  double quiet_change(std::int64_t at) const {
    return kl_ * plate_step_ * (loading(at) + 0.5 * blocks_ * plate_step_);
  }

  /// Adds the step from step - 1 to step.
  void add(const StepSums &sums, std::int64_t step) {
    const double loading_before = loading(step - 1);
    if (sums.slip == 0.0 && sums.work == 0.0) {
      if (!quiet()) {
        quiet_since_ = step - 1;
        anchor_ = value_;
        loading_anchor_ = loading_before;
      }
      change_ = quiet_change(step - 1);
      value_ = quiet_value(step);
      return;
    }
    if (quiet()) {
      pe_ = LSM::NeumaierSum(value_);
      quiet_since_ = -1;
    }
    slip_.add(sums.slip);
    change_ = 0.5 * kl_ * plate_step_ * (loading_before + loading(step)) - sums.work;
    pe_.add(change_);
    value_ = pe_.value();
  }
  /// Accounts for a leap, in which blocks moved without steps.
  /// \param changed change of PE in the leap
  /// \param change change over its last step
  void leap(double changed, double change, const double *u) {
    pe_ = LSM::NeumaierSum(value_);
    pe_.add(changed);
    value_ = pe_.value();
    change_ = change;
    slip_ = LSM::NeumaierSum();
    for (int i = 0; i < static_cast<int>(blocks_); ++i) slip_.add(u[i]);
    quiet_since_ = -1;
  }

  void save(ChainState &s) const {
    s.slip_sum = slip_.sum();
    s.slip_compensation = slip_.compensation();
    s.pe_sum = pe_.sum();
    s.pe_compensation = pe_.compensation();
    s.quiet_since = quiet_since_;
    s.pe_anchor = anchor_;
    s.loading_anchor = loading_anchor_;
    s.dpe = change_;
  }
  void restore(const ChainState &s) {
    slip_ = LSM::NeumaierSum(s.slip_sum, s.slip_compensation);
    pe_ = LSM::NeumaierSum(s.pe_sum, s.pe_compensation);
    quiet_since_ = s.quiet_since;
    anchor_ = s.pe_anchor;
    loading_anchor_ = s.loading_anchor;
    change_ = s.dpe;
    value_ = quiet() ? quiet_value(s.step) : pe_.value();
  }

 private:
  // sum (X - U_i) at a step, with the present displacements.
  double loading(std::int64_t at) const {
    return blocks_ * (plate_step_ * static_cast<double>(at)) - slip_.value();
  }

  // In a quiet period PE is computed from its first step, not from the previous one, so that it
  // does not depend on the steps at which it is evaluated.
  double quiet_value(std::int64_t step) const {
    const double travel = plate_step_ * static_cast<double>(step - quiet_since_);
    return anchor_ + kl_ * travel * (loading_anchor_ + 0.5 * blocks_ * travel);
  }

  double kl_, plate_step_, blocks_;
  LSM::NeumaierSum slip_, pe_;
  double value_ = 0.0, change_ = 0.0;
  std::int64_t quiet_since_ = -1;
  double anchor_ = 0.0, loading_anchor_ = 0.0;
};

}  // namespace Slider

#endif
