// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_record.h"

#include "comm.h"
#include "compute_lsm_events.h"
#include "error.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

FixLSMRecord::FixLSMRecord(LAMMPS *_lmp, int narg, char **arg) :
    LSMKeptFix(_lmp, narg, arg), owner(nullptr)
{
  if (narg != 3) error->all(FLERR, "Fix LSM_RECORD is internal to compute lsm/events");
  nevery = 1;
}

int FixLSMRecord::setmask()
{
  return PRE_EXCHANGE | END_OF_STEP | POST_RUN;
}

void FixLSMRecord::setup(int /*vflag*/)
{
  owner->setup_record();
}

void FixLSMRecord::pre_exchange()
{
  owner->look_early();
}

void FixLSMRecord::end_of_step()
{
  owner->record();
}

void FixLSMRecord::post_run()
{
  owner->end_run();
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
