// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault/energy_ledger.h
/// Balance of the energies and works of a run; any residual comes from the integration.
#ifndef LSM_ENERGY_LEDGER_H
#define LSM_ENERGY_LEDGER_H

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace LSM {

/// Energies at one moment and works since the first run, of all ranks.
struct EnergyTerms {
  double kinetic = 0.0;     ///< without the driven motion of the plates
  double potential = 0.0;   ///< of all springs, whether they count as PE or not
  double friction = 0.0;    ///< lost to friction
  double viscosity = 0.0;   ///< lost to viscosity
  double broken = 0.0;      ///< lost with links that broke
  double plates = 0.0;      ///< done by the plates
  double counted_pe = 0.0;  ///< what counts as PE
  double outside = 0.0;     ///< done by given forces
  double absorbed = 0.0;    ///< lost to borders that absorb waves
  double within = 0.0;      ///< part of friction that is lost elsewhere than across the fault

  double balance() const {
    return kinetic + potential + friction + viscosity + broken + absorbed - plates - outside;
  }
  /// Scale to which residuals are compared.
  double scale() const { return friction + viscosity + absorbed + kinetic + std::fabs(counted_pe); }
};

/// Whether a change of energy is larger than rounding of positions explains.
/// \param floor limit where the energy is near zero
inline bool is_jump(double change, double energy, double floor) {
  return std::fabs(change) > std::max(floor, 1e-9 * energy);
}

/// Keeps the balance of energies and works over several runs.
class EnergyLedger {
 public:
  bool begun() const { return begun_; }
  /// Starts the balance.
  void begin(const EnergyTerms &now) {
    start_ = now.balance();
    begun_ = true;
  }

  /// Unaccounted energy since begin().
  double residual(const EnergyTerms &now) const { return now.balance() - start_; }

  /// Records the end of a run.
  void end_run(std::int64_t step, const EnergyTerms &now) {
    if (begun_) residual_at_end_ = residual(now);
    ended_at_ = step;
  }
  /// Removes a jump of energy that a command between two runs has caused from the balance.
  /// \param now returns the energies; called only if there is something to compare with
  /// \return the jump, or 0
  template <class Now>
  double leave_out_jump(std::int64_t step, double floor, Now &&now) {
    if (!begun_ || ended_at_ != step) return 0.0;
    const EnergyTerms terms = now();
    const double jump = residual(terms) - residual_at_end_;
    if (!is_jump(jump, terms.scale(), floor)) return 0.0;
    start_ += jump;
    return jump;
  }

  /// The state for a restart file, with the works so far: the styles of the run that continues from
  /// it do not know them.
  EnergyLedger for_restart(const EnergyTerms &now) const {
    EnergyLedger saved = *this;
    saved.friction_before_ = now.friction;
    saved.broken_before_ = now.broken;
    saved.within_before_ = now.within;
    return saved;
  }
  template <class Self, class State>
  static void visit(Self &self, State &state) {
    state(self.begun_, self.start_, self.friction_before_, self.broken_before_,
          self.within_before_);
  }
  /// Adds the works before the last restart.
  /// \param now with works since the last restart
  EnergyTerms with_earlier_works(EnergyTerms now) const {
    now.friction = friction_before_ + now.friction;
    now.broken = broken_before_ + now.broken;
    now.within = within_before_ + now.within;
    return now;
  }

 private:
  bool begun_ = false;
  double start_ = 0.0;
  double friction_before_ = 0.0, broken_before_ = 0.0, within_before_ = 0.0;
  double residual_at_end_ = 0.0;
  std::int64_t ended_at_ = -1;
};

}  // namespace LSM

#endif
