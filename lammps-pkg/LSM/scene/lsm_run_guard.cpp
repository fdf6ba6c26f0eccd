// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_run_guard.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include "lsm_event_sources.h"
#include "lsm_mover.h"
#include "lsm_ranks.h"
#include "lsm_script.h"

#include <cmath>

using namespace LAMMPS_NS;

LSMRunGuard::LSMRunGuard(LAMMPS *_lmp, const LSMEventSources &_sources,
                         const LSM::WatchdogSettings &settings, const std::string &file) :
    Pointers(_lmp),
    sources(_sources), watchdog(settings), emergency_file(file)
{
}

void LSMRunGuard::begin_run()
{
  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, 2.0 * atom->radius[i]);
  widest = lsm_largest(mine, world);
  watchdog.reset();
}

// In the middle of a step there is no energy to check and no state for a restart file, so other
// checks wait until the step is complete.
LSM::Watchdog::Alarm LSMRunGuard::check_links()
{
  if (!sources.has_links()) return {};
  const double strain = lsm_largest(LSM::Watchdog::comparable(sources.max_strain()), world);
  return {watchdog.check_links(strain, widest, comm->get_comm_cutoff()), false};
}

LSM::Watchdog::Alarm LSMRunGuard::check_step(const LSM::EnergyLedger &ledger,
                                             const std::function<LSM::EnergyTerms()> &energies)
{
  const double mine[2] = {std::isfinite(sources.pe()) ? 0.0 : 1.0,
                          LSM::Watchdog::comparable(sources.max_strain())};
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  return watchdog.check(all[0] == 0.0, all[1], ledger, [&] {
    LSMMover::complete_steps(modify);
    return energies();
  });
}

// a restart file of a state that is not finite would be useless, and would replace an older one
void LSMRunGuard::stop_run(const LSM::Watchdog::Alarm &alarm)
{
  if (alarm.finite) {
    LSMMover::complete_steps(modify);
    LSMScript::save_restart(lmp, emergency_file, LSMScript::listed(lmp, LSMScript::SAVED), true);
  }
  error->all(FLERR, Error::NOLASTLINE,
             "Run stopped at step {}: {}. {}; use a smaller time step or start from an earlier "
             "restart",
             update->ntimestep, alarm.what,
             alarm.finite ? "Wrote restart file " + emergency_file
                          : "The catalogue ends with the last event before it");
}
