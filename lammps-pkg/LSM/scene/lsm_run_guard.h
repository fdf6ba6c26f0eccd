// SPDX-License-Identifier: GPL-2.0-or-later
// Stops a run that has failed, after what is recorded has been written

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
  /// \param flush writes what has been recorded
  LSMRunGuard(LAMMPS *, const LSMEventSources &, const LSM::WatchdogSettings &,
              const std::string &emergency_file, std::function<void()> flush);
  void begin_run();
  bool due(bigint step) const { return watchdog.due(step); }
  /// Checks the links before neighbor lists are built, as a link torn beyond the ghosts would stop
  /// LAMMPS with 'Bond atoms missing'.
  void check_links();
  /// Checks the state at the end of a step.
  void check_step(const LSM::EnergyLedger &, const std::function<LSM::EnergyTerms()> &energies);

 private:
  const LSMEventSources &sources;
  LSM::Watchdog watchdog;
  const std::string emergency_file;
  const std::function<void()> flush;
  double widest = 0.0;    // largest diameter

  [[noreturn]] void stop_run(const std::string &what, const std::string &left);
};

}    // namespace LAMMPS_NS

#endif
