// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_record.h"

#include "atom.h"
#include "compute_lsm_events.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

FixLSMRecord::FixLSMRecord(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  const bool faces = narg == 4 && strcmp(arg[3], "faces") == 0;
  if (narg != 3 && !faces) error->all(FLERR, "Fix LSM_RECORD is internal to compute lsm/events");
  nevery = 1;
  if (!faces) return;
  directions = domain->dimension == 3 ? 2 : 1;
  create_attribute = 1;    // new particles have not moved
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

void FixLSMRecord::setup(int /*vflag*/)
{
  owner->setup_record();
}

void FixLSMRecord::pre_exchange()
{
  owner->check_links();
}

void FixLSMRecord::end_of_step()
{
  owner->end_step();
}

void FixLSMRecord::post_run()
{
  owner->end_run();
}

// a run notices changes made before it in its setup
void FixLSMRecord::reset_dt()
{
  update->whichflag ? owner->change_dt() : LSMScene::set_up_next_run(lmp);
}

void FixLSMRecord::write_restart(FILE *fp)
{
  saved_state = owner->pack_state();
  LSMKeptFix::write_restart(fp);
}

FixLSMRecord::~FixLSMRecord()
{
  if (!x_before) return;
  if (modify->get_fix_by_id(id)) atom->delete_callback(id, Atom::GROW);
  memory->destroy(x_before);
}

void FixLSMRecord::begin_faces()
{
  for (int i = 0; i < atom->nlocal; i++) FixLSMRecord::set_arrays(i);
  since = update->ntimestep;
}

std::vector<LSM::FaceDisplacement> FixLSMRecord::faces(int lower, int upper) const
{
  std::vector<LSM::FaceDisplacement> faces;
  const auto steps = static_cast<double>(update->ntimestep - since);
  if (steps <= 0.0) return faces;
  const auto moved = [this](int i, int direction) {
    const int d = 2 * direction;
    const double more = atom->x[i][d] - x_before[directions * i + direction];
    return domain->periodicity[d] ? more - domain->prd[d] * std::round(more / domain->prd[d])
                                  : more;
  };
  for (int i = 0; i < atom->nlocal; i++) {
    const bool above = atom->mask[i] & upper;
    if (!above && !(atom->mask[i] & lower)) continue;
    const double d = moved(i, 0), e = directions == 2 ? moved(i, 1) : 0.0;
    faces.push_back({atom->x[i][0] - 0.5 * d, d, steps, above, atom->x[i][2] - 0.5 * e, e});
  }
  return faces;
}

void FixLSMRecord::grow_arrays(int nmax)
{
  memory->grow(x_before, directions * nmax, "lsm/events:x_before");
}

void FixLSMRecord::copy_arrays(int i, int j, int)
{
  for (int n = 0; n < directions; n++) x_before[directions * j + n] = x_before[directions * i + n];
}

void FixLSMRecord::set_arrays(int i)
{
  for (int n = 0; n < directions; n++) x_before[directions * i + n] = atom->x[i][2 * n];
}

int FixLSMRecord::pack_exchange(int i, double *buf)
{
  for (int n = 0; n < directions; n++) buf[n] = x_before[directions * i + n];
  return directions;
}

int FixLSMRecord::unpack_exchange(int i, double *buf)
{
  for (int n = 0; n < directions; n++) x_before[directions * i + n] = buf[n];
  return directions;
}

double FixLSMRecord::memory_usage()
{
  return x_before ? static_cast<double>(atom->nmax) * directions * sizeof(double) : 0.0;
}
