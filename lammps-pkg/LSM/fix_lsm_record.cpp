// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_record.h"

#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

FixLSMRecord::FixLSMRecord(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  if (narg != 3) error->all(FLERR, "Fix LSM_RECORD is internal to compute lsm/events");
  nevery = 1;
}

// within a run; between two runs the next run notices
void FixLSMRecord::reset_dt()
{
  if (update->whichflag) owner->change_dt();
}

void FixLSMRecord::write_restart(FILE *fp)
{
  kept = owner->pack_state();
  LSMKeptFix::write_restart(fp);
}
