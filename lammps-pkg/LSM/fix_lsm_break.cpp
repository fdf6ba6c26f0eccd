/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "fix_lsm_break.h"

#include "atom.h"
#include "bond_lsm_linked.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixLSMBreak::FixLSMBreak(LAMMPS *_lmp, int narg, char **arg) :
    Fix(_lmp, narg, arg), links(nullptr), total(0)
{
  if (narg != 3) error->all(FLERR, "Fix LSM_BREAK is internal to bond style lsm/linked");
  scalar_flag = 1;
  extscalar = 0;
  global_freq = 1;
  nevery = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
}

/* ---------------------------------------------------------------------- */

int FixLSMBreak::setmask()
{
  return PRE_EXCHANGE | END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixLSMBreak::init()
{
  links = dynamic_cast<BondLSMLinked *>(force->bond_match("lsm/linked"));
  if (!links) error->all(FLERR, "Fix LSM_BREAK needs bond style lsm/linked");
  if (force->special_lj[1] != 0.0 || force->special_lj[2] != 1.0 || force->special_lj[3] != 1.0)
    error->all(FLERR, "Breakable links need 'special_bonds lj 0 1 1', so that a pair is in contact "
                      "only when its link is broken");
}

/* ----------------------------------------------------------------------
   A link broken in step t is gone from every list before the forces of step t+1: its length exceeds the
   rest length then, so the pair cannot have touched in between.
------------------------------------------------------------------------- */

void FixLSMBreak::end_of_step()
{
  int mine = static_cast<int>(links->broken.size()), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_SUM, world);
  if (all) next_reneighbor = update->ntimestep + 1;
}

/* ---------------------------------------------------------------------- */

void FixLSMBreak::setup_pre_exchange()
{
  apply();
}

void FixLSMBreak::pre_exchange()
{
  apply();
}

/* ---------------------------------------------------------------------- */

void FixLSMBreak::apply()
{
  int mine = static_cast<int>(links->broken.size());
  std::vector<int> counts(comm->nprocs), offsets(comm->nprocs);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  int sum = 0;
  for (int p = 0; p < comm->nprocs; p++) {
    offsets[p] = sum;
    sum += counts[p];
  }
  if (sum == 0) return;

  std::vector<tagint> pairs(sum);
  MPI_Allgatherv(links->broken.data(), mine, MPI_LMP_TAGINT, pairs.data(), counts.data(),
                 offsets.data(), MPI_LMP_TAGINT, world);
  links->broken.clear();

  // two ranks may report the same link

  std::vector<std::pair<tagint, tagint>> unique;
  for (int n = 0; n < sum; n += 2)
    unique.emplace_back(std::min(pairs[n], pairs[n + 1]), std::max(pairs[n], pairs[n + 1]));
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());

  bigint removed = 0;
  for (const auto &p : unique) {
    for (int side = 0; side < 2; side++) {
      const tagint own = side ? p.second : p.first;
      const tagint other = side ? p.first : p.second;
      const int i = atom->map(own);
      if (i < 0 || i >= atom->nlocal) continue;

      for (int m = 0; m < atom->num_bond[i]; m++)
        if (atom->bond_atom[i][m] == other) {
          const int last = --atom->num_bond[i];
          atom->bond_atom[i][m] = atom->bond_atom[i][last];
          atom->bond_type[i][m] = atom->bond_type[i][last];
          removed++;
          break;
        }

      // 1-2 neighbours are the first nspecial[0]; what follows moves up

      tagint *special = atom->special[i];
      int *nspecial = atom->nspecial[i];
      for (int m = 0; m < nspecial[0]; m++)
        if (special[m] == other) {
          for (int n = m; n < nspecial[2] - 1; n++) special[n] = special[n + 1];
          nspecial[0]--;
          nspecial[1]--;
          nspecial[2]--;
          break;
        }
    }
  }
  bigint removed_all = 0;
  MPI_Allreduce(&removed, &removed_all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint links_removed = force->newton_bond ? removed_all : removed_all / 2;
  atom->nbonds -= links_removed;
  total += links_removed;
}

/* ---------------------------------------------------------------------- */

double FixLSMBreak::compute_scalar()
{
  return static_cast<double>(total);
}
