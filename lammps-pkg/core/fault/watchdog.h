// SPDX-License-Identifier: GPL-2.0-or-later
/// \file fault/watchdog.h
/// Detects failed runs: energies that are not finite, links strained too far, a ledger out of
/// balance.
#ifndef LSM_WATCHDOG_H
#define LSM_WATCHDOG_H

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "fault/energy_ledger.h"

namespace LSM {

/// What a Watchdog checks.
struct WatchdogSettings {
  double strain_limit = 0.5;  ///< largest strain of a link
  double tolerance = 0.0;     ///< residual of the ledger over its scale; 0: not checked
  int every = 1000;           ///< steps between two checks
};

/// Checks the state of a run every so many steps.
class Watchdog {
 public:
  /// Result of a check.
  struct Alarm {
    std::string what;    ///< what is wrong, or ""
    bool finite = true;  ///< whether the state is worth a restart file
  };

  explicit Watchdog(const WatchdogSettings &settings) : settings_(settings) {}

  /// Replaces strains that are not finite, as a maximum over ranks would lose a NaN.
  static double comparable(double strain) { return std::isfinite(strain) ? strain : not_finite; }

  void reset() { alarmed_ = false; }
  bool due(std::int64_t step) const { return alarmed_ || step % settings_.every == 0; }

  /// Checks the links in the middle of a step, before they can be torn beyond the ghosts. If the
  /// strain is above its limit, schedules a check at the end of the step.
  /// \param widest largest rest length of a link
  /// \param reach of the ghosts
  /// \return what is wrong if the most strained link may be longer than the ghosts reach, or ""
  std::string check_links(double strain, double widest, double reach) {
    alarmed_ = strain > settings_.strain_limit;
    if (!alarmed_ || (1.0 + strain) * widest <= reach) return {};
    return strain >= not_finite ? "positions are not finite" : strained(strain);
  }

  /// Checks the state at the end of a step.
  /// \param terms returns the energies; called only if the ledger is checked
  template <class Terms>
  Alarm check(bool pe_finite, double strain, const EnergyLedger &ledger, Terms &&terms) {
    alarmed_ = false;
    if (!pe_finite || strain >= not_finite) return {"the potential energy is not finite", false};
    if (strain > settings_.strain_limit) return {strained(strain), true};
    if (!(settings_.tolerance > 0.0)) return {};
    const EnergyTerms now = terms();
    const double off = ledger.residual(now), scale = now.scale();
    if (!(std::fabs(off) > settings_.tolerance * scale)) return {};
    return {"the energy ledger is out of balance by " + text(off) + " of " + text(scale) +
                ", above tolerance " + text(settings_.tolerance),
            true};
  }

 private:
  static constexpr double not_finite = 1e300;

  static std::string text(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.4g", value);
    return digits;
  }
  std::string strained(double strain) const {
    return "a link is strained by " + text(strain) + ", above strainlimit " +
           text(settings_.strain_limit);
  }

  WatchdogSettings settings_;
  bool alarmed_ = false;  // check_links() found something in this step
};

}  // namespace LSM

#endif
