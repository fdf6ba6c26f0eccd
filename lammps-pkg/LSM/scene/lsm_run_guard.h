// SPDX-License-Identifier: GPL-2.0-or-later
// Notices that a run has failed, and stops it

#ifndef LMP_LSM_RUN_GUARD_H
#define LMP_LSM_RUN_GUARD_H

#include "fault/watchdog.h"
#include "pointers.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {
class LSMEventSources;

class LSMRunGuard : protected Pointers {
 public:
  /// \param emergency_file restart file that is written when a run is stopped
  LSMRunGuard(LAMMPS *, const LSMEventSources &, const LSM::WatchdogSettings &,
              const std::string &emergency_file);
  void begin_run();
  bool due(bigint step) const { return watchdog.due(step); }
  /// Checks the links before neighbor lists are built, as a link torn beyond the ghosts would stop
  /// LAMMPS with 'Bond atoms missing'.
  LSM::Watchdog::Alarm check_links();
  /// Checks the state at the end of a step.
  LSM::Watchdog::Alarm check_step(const LSM::EnergyLedger &,
                                  const std::function<LSM::EnergyTerms()> &energies);
  /// Ends the run, after what is recorded has been written.
  [[noreturn]] void stop_run(const LSM::Watchdog::Alarm &);

 private:
  const LSMEventSources &sources;
  LSM::Watchdog watchdog;
  const std::string emergency_file;
  double widest = 0.0;    // largest diameter
};

}    // namespace LAMMPS_NS

#endif
