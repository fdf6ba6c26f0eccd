/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "fix_lsm_record.h"

#include "comm.h"
#include "compute_lsm_events.h"
#include "error.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixLSMRecord::FixLSMRecord(LAMMPS *_lmp, int narg, char **arg) :
    Fix(_lmp, narg, arg), owner(nullptr)
{
  if (narg != 3) error->all(FLERR, "Fix LSM_RECORD is internal to compute lsm/events");
  nevery = 1;
  restart_global = 1;
}

/* ---------------------------------------------------------------------- */

int FixLSMRecord::setmask()
{
  return PRE_EXCHANGE | END_OF_STEP | POST_RUN;
}

/* ---------------------------------------------------------------------- */

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

// within a run; between two runs the next one finds out

void FixLSMRecord::reset_dt()
{
  if (update->whichflag) owner->change_dt();
}

/* ---------------------------------------------------------------------- */

void FixLSMRecord::write_restart(FILE *fp)
{
  const std::vector<double> state = owner->pack_state();
  if (comm->me == 0) {
    const int size = static_cast<int>((state.size() + 1) * sizeof(double));
    const auto count = static_cast<double>(state.size());
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(&count, sizeof(double), 1, fp);
    fwrite(state.data(), sizeof(double), state.size(), fp);
  }
}

void FixLSMRecord::restart(char *buf)
{
  double count;
  memcpy(&count, buf, sizeof(double));
  restart_state.resize(static_cast<size_t>(count));
  memcpy(restart_state.data(), buf + sizeof(double), restart_state.size() * sizeof(double));
}
