/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "fix_lsm_history.h"

#include "comm.h"
#include "error.h"
#include "lsm_scene.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixLSMHistory::FixLSMHistory(LAMMPS *_lmp, int narg, char **arg) : FixNeighHistory(_lmp, narg, arg)
{
  // as fix NEIGH_HISTORY in restart files

  delete[] style;
  style = utils::strdup("NEIGH_HISTORY");

  // partners of a contact are kept by their ID

  stores_ids = 1;
}

/* ---------------------------------------------------------------------- */

void FixLSMHistory::init()
{
  FixNeighHistory::init();
  if (update->whichflag == 2)
    error->all(FLERR, "Pair style lsm/friction does not work with minimize: friction depends on the path, so there is no "
                      "energy to be minimized; use pair style lsm/free, or a run with viscosity");
  if (LSMScene::is_rerun(update))
    error->all(FLERR, "Pair style lsm/friction does not work with rerun: snapshots do not hold the elongations of the "
                      "tangential springs; use pair style lsm/free for the energy of the normal springs");
}

/* ----------------------------------------------------------------------
   Fix NEIGH_HISTORY gathers the history of each particle from the neighbor list once more. The command
   write_restart has moved particles and renewed ghosts by then, so the list names other particles. Between
   two runs each particle has its history already, see post_run().
------------------------------------------------------------------------- */

void FixLSMHistory::write_restart(FILE *fp)
{
  if (update->whichflag) {
    FixNeighHistory::write_restart(fp);
  } else if (comm->me == 0) {
    const int size = 0;
    fwrite(&size, sizeof(int), 1, fp);
  }
}
