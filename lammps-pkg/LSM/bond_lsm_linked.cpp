/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "bond_lsm_linked.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"

#include "lsm_force_laws.h"
#include "lsm_sum.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

BondLSMLinked::BondLSMLinked(LAMMPS *_lmp) :
    Bond(_lmp), k(nullptr), ratio(nullptr), breakable(0), maxrad(0.0)
{
  writedata = 1;
}

/* ---------------------------------------------------------------------- */

BondLSMLinked::~BondLSMLinked()
{
  if (modify && modify->get_fix_by_id("LSM_BREAK")) modify->delete_fix("LSM_BREAK");
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(k);
    memory->destroy(ratio);
  }
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  const int choice = (evflag ? 8 : 0) + (record_what ? 4 : 0) + (breakable ? 2 : 0) +
      (domain->dimension == 3 ? 1 : 0);
  switch (choice) {
    case 0: return eval<false, false, false, false>();
    case 1: return eval<false, false, false, true>();
    case 2: return eval<false, false, true, false>();
    case 3: return eval<false, false, true, true>();
    case 4: return eval<false, true, false, false>();
    case 5: return eval<false, true, false, true>();
    case 6: return eval<false, true, true, false>();
    case 7: return eval<false, true, true, true>();
    case 8: return eval<true, false, false, false>();
    case 9: return eval<true, false, false, true>();
    case 10: return eval<true, false, true, false>();
    case 11: return eval<true, false, true, true>();
    case 12: return eval<true, true, false, false>();
    case 13: return eval<true, true, false, true>();
    case 14: return eval<true, true, true, false>();
    default: return eval<true, true, true, true>();
  }
}

/* ----------------------------------------------------------------------
   With newton_bond off the first particle of a link in the list is always owned, and a link to a ghost
   stands in the list of both ranks: half of its energy is counted on each.
------------------------------------------------------------------------- */

template <bool EV, bool RECORD, bool BREAK, bool DIM3> void BondLSMLinked::eval()
{
  // 256 links a partial sum: the rounding error of the total then grows with the number of partial sums,
  // which are added with compensation

  constexpr int CHUNK = 256;

  if (atom->nlocal + atom->nghost == 0) {
    if constexpr (RECORD) pe_link = 0.0;
    return;
  }

  const double *const x = atom->x[0];
  double *const f = atom->f[0];
  const double *const radius = atom->radius;
  int **const bondlist = neighbor->bondlist;
  const int nbondlist = neighbor->nbondlist;
  const int nlocal = atom->nlocal;
  const int newton_bond = force->newton_bond;
  const double *const stiffness = k;

  LSM::NeumaierSum sum;

  for (int first = 0; first < nbondlist; first += CHUNK) {
    const int last = MIN(first + CHUNK, nbondlist);
    double twice = 0.0;
    for (int n = first; n < last; n++) {
      const int i = bondlist[n][0];
      const int j = bondlist[n][1];
      const int type = bondlist[n][2];
      if constexpr (BREAK)
        if (type <= 0) continue;

      const double delx = x[3 * i] - x[3 * j];
      const double dely = x[3 * i + 1] - x[3 * j + 1];
      double delz = 0.0;
      double rsq = delx * delx + dely * dely;
      if constexpr (DIM3) {
        delz = x[3 * i + 2] - x[3 * j + 2];
        rsq += delz * delz;
      }
      const double r0 = radius[i] + radius[j];
      const double r = sqrt(rsq);

      if constexpr (BREAK)
        if (ratio[type] > 0.0 && LSM::link_is_broken(r, r0, ratio[type])) {
          bondlist[n][2] = 0;
          if constexpr (RECORD)
            work_broken += (newton_bond || j < nlocal ? 1.0 : 0.5) *
                LSM::Spring::energy(stiffness[type], r - r0);
          broken.push_back(atom->tag[i]);
          broken.push_back(atom->tag[j]);
          continue;
        }

      const double pull = LSM::Spring::force(stiffness[type], r - r0);
      const double fbond = -pull / r;
      const bool both = newton_bond || j < nlocal;
      const double fx = delx * fbond, fy = dely * fbond;
      f[3 * i] += fx;
      f[3 * i + 1] += fy;
      if constexpr (DIM3) f[3 * i + 2] += delz * fbond;
      if (both) {
        f[3 * j] -= fx;
        f[3 * j + 1] -= fy;
        if constexpr (DIM3) f[3 * j + 2] -= delz * fbond;
      }
      if constexpr (RECORD) twice += (both ? 1.0 : 0.5) * (pull * (r - r0));
      if constexpr (EV)
        ev_tally(i, j, nlocal, newton_bond, LSM::Spring::energy(stiffness[type], r - r0), fbond,
                 delx, dely, delz);
    }
    if constexpr (RECORD) sum.add(twice);
  }
  if constexpr (RECORD) pe_link = 0.5 * sum.value();
}

/* ---------------------------------------------------------------------- */

double BondLSMLinked::max_strain() const
{
  double **x = atom->x;
  double worst = 0.0;
  for (int n = 0; n < neighbor->nbondlist; n++) {
    if (neighbor->bondlist[n][2] <= 0) continue;
    const int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
    const double r0 = atom->radius[i] + atom->radius[j];
    const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
    const double strain = fabs(sqrt(dx * dx + dy * dy + dz * dz) - r0) / r0;
    if (!(strain <= worst)) worst = strain;    // a NaN counts as worst
  }
  return worst;
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::allocate()
{
  allocated = 1;
  const int n = atom->nbondtypes + 1;
  memory->create(k, n, "bond:k");
  memory->create(ratio, n, "bond:ratio");
  memory->create(setflag, n, "bond:setflag");
  for (int i = 0; i < n; i++) {
    setflag[i] = 0;
    k[i] = ratio[i] = 0.0;
  }
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::settings(int narg, char ** /*arg*/)
{
  if (narg != 0)
    error->all(FLERR, "Bond style lsm/linked takes no arguments, but {} were given", narg);
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::coeff(int narg, char **arg)
{
  if (narg != 2 && narg != 3)
    error->all(FLERR, "Bond style lsm/linked expects 'bond_coeff N k [ratio]' with the breaking "
                      "distance ratio = r_cut/r0 > 1, or no ratio for links that never break");
  if (!allocated) allocate();

  int ilo, ihi;
  utils::bounds(FLERR, arg[0], 1, atom->nbondtypes, ilo, ihi, error);
  const double k_one = utils::numeric(FLERR, arg[1], false, lmp);
  const double ratio_one = narg == 3 ? utils::numeric(FLERR, arg[2], false, lmp) : 0.0;
  if (k_one <= 0.0) error->all(FLERR, "Bond lsm/linked stiffness is {}, but must be > 0", k_one);
  if (narg == 3 && ratio_one <= 1.0)
    error->all(FLERR, "Bond lsm/linked breaking ratio r_cut/r0 is {}, but must be > 1", ratio_one);

  int count = 0;
  for (int i = ilo; i <= ihi; i++) {
    k[i] = k_one;
    ratio[i] = ratio_one;
    setflag[i] = 1;
    count++;
  }
  if (count == 0) error->all(FLERR, "Bond lsm/linked: bond_coeff {} names no bond type", arg[0]);
  breakable = 0;
  for (int i = 1; i <= atom->nbondtypes; i++)
    if (ratio[i] > 0.0) breakable = 1;
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::init_style()
{
  if (!atom->radius_flag)
    error->all(FLERR, "Bond style lsm/linked needs particle radii: use atom_style hybrid bond sphere");
  record_what = NONE;

  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, atom->radius[i]);
  MPI_Allreduce(&mine, &maxrad, 1, MPI_DOUBLE, MPI_MAX, world);

  // only links that can break need the fix that tells the other ranks and updates the topology

  if (breakable && !modify->get_fix_by_id("LSM_BREAK"))
    modify->add_fix("LSM_BREAK all LSM_BREAK");
}

/* ----------------------------------------------------------------------
   the rest length is r_i + r_j; LAMMPS asks for one number a type
------------------------------------------------------------------------- */

double BondLSMLinked::equilibrium_distance(int /*i*/)
{
  return 2.0 * maxrad;
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::write_restart(FILE *fp)
{
  fwrite(&k[1], sizeof(double), atom->nbondtypes, fp);
  fwrite(&ratio[1], sizeof(double), atom->nbondtypes, fp);
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::read_restart(FILE *fp)
{
  allocate();
  const int n = atom->nbondtypes;
  if (comm->me == 0) {
    utils::sfread(FLERR, &k[1], sizeof(double), n, fp, nullptr, error);
    utils::sfread(FLERR, &ratio[1], sizeof(double), n, fp, nullptr, error);
  }
  MPI_Bcast(&k[1], n, MPI_DOUBLE, 0, world);
  MPI_Bcast(&ratio[1], n, MPI_DOUBLE, 0, world);
  for (int i = 1; i <= n; i++) {
    setflag[i] = 1;
    if (ratio[i] > 0.0) breakable = 1;
  }
}

/* ---------------------------------------------------------------------- */

void BondLSMLinked::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->nbondtypes; i++)
    if (ratio[i] > 0.0)
      fprintf(fp, "%d %.17g %.17g\n", i, k[i], ratio[i]);
    else
      fprintf(fp, "%d %.17g\n", i, k[i]);
}

/* ---------------------------------------------------------------------- */

double BondLSMLinked::single(int type, double rsq, int i, int j, double &fforce)
{
  const double r = sqrt(rsq);
  const double stretch = r - (atom->radius[i] + atom->radius[j]);
  fforce = r > 0.0 ? -LSM::Spring::force(k[type], stretch) / r : 0.0;
  return LSM::Spring::energy(k[type], stretch);
}

/* ---------------------------------------------------------------------- */

void *BondLSMLinked::extract(const char *str, int &dim)
{
  dim = 1;
  if (strcmp(str, "k") == 0) return (void *) k;
  return nullptr;
}
