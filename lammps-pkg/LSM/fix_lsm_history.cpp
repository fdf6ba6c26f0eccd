// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_history.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lsm_scene.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

FixLSMHistory::FixLSMHistory(LAMMPS *_lmp, int narg, char **arg) :
    FixNeighHistory(_lmp, MIN(narg, 4), arg), law(narg == 5 ? arg[4] : ""), law_of_file("")
{
  if (narg > 5) error->all(FLERR, "Fix LSM_HISTORY is internal to pair style lsm/friction");

  // restart files know it as fix NEIGH_HISTORY
  delete[] style;
  style = utils::strdup("NEIGH_HISTORY");

  // partners of a contact are stored by ID
  stores_ids = 1;
}

void FixLSMHistory::init()
{
  if (ipage_atom && (pgsize != neighbor->pgsize || oneatom != neighbor->oneatom))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/friction would lose its contacts: 'neigh_modify one {} page {}' "
               "became 'one {} page {}' after the first run; give neigh_modify one and page before "
               "it, or continue from a restart file",
               oneatom, pgsize, neighbor->oneatom, neighbor->pgsize);
  FixNeighHistory::init();
  if (update->whichflag == 2)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/friction does not work with minimize: friction depends on "
               "the path, so there is no "
               "energy to be minimized; use pair style lsm/free, or a run with viscosity");
  if (LSMScene::is_rerun(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/friction does not work with rerun: snapshots do not hold the "
               "elongations of the "
               "tangential springs; use pair style lsm/free for the energy of the normal springs");
}

void FixLSMHistory::pre_exchange()
{
  gather_states();
  FixNeighHistory::pre_exchange();
}

void FixLSMHistory::post_neighbor()
{
  rows.clear();    // pre_exchange() reads them until the list is built anew
  FixNeighHistory::post_neighbor();
}

void FixLSMHistory::add_pair(int i, int jj)
{
  Row &row = rows[i];
  if (row.touch.empty()) {
    row.touch.assign(firstflag[i], firstflag[i] + jj);
    row.values.assign(firstvalue[i], firstvalue[i] + static_cast<size_t>(dnum) * jj);
  }
  row.touch.push_back(0);
  row.values.resize(row.values.size() + dnum, 0.0);
  firstflag[i] = row.touch.data();
  firstvalue[i] = row.values.data();
}

// Fix NEIGH_HISTORY would gather the history of each particle from the neighbor list again. The
// command write_restart has moved particles and renewed ghosts by then, so the list refers to other
// particles. Between two runs, and between the pieces of one, each particle has its history
// already, see post_run().
void FixLSMHistory::write_restart(FILE *fp)
{
  if (gather_states()) FixNeighHistory::pre_exchange();
  if (comm->me) return;
  const int size = law.empty() ? 0 : static_cast<int>(law.size()) + 1;
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(law.c_str(), 1, size, fp);
}

// A law without a state writes nothing here, and then there is nothing to read: the buffer is used
// only for contacts of the right size, see below.
void FixLSMHistory::restart(char *buf)
{
  law_of_file = buf;
}

void FixLSMHistory::unpack_restart(int nlocal, int nth)
{
  const double *extra = atom->extra[nlocal];
  int m = 0;
  for (int i = 0; i < nth; i++) m += static_cast<int>(extra[m]);
  const int count = static_cast<int>(extra[m + 1]);
  if (count > 0) {
    const std::string mine = law.empty() ? "a law without a state" : "the law " + law;
    const int size = (static_cast<int>(extra[m]) - 2) / count - 1;
    if (size != dnum)
      error->one(FLERR, Error::NOLASTLINE,
                 "Pair style lsm/friction: the restart file holds contacts of another friction "
                 "law, with {} numbers each, but {} has {}",
                 size, mine, dnum);
    if (!law.empty() && law != law_of_file)
      error->one(FLERR, Error::NOLASTLINE,
                 "Pair style lsm/friction: the restart file holds contacts of the law {}, expected "
                 "those of {}",
                 law_of_file, mine);
  }
  FixNeighHistory::unpack_restart(nlocal, nth);
}
