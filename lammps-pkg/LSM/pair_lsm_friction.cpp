/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "pair_lsm_friction.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_dummy.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include "lsm_force_laws.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;

// values stored per pair: elongation of the tangential spring along the tangent (-ny,nx), the vector from j
// to i in the step before, and the state. Always four, so that a restart may switch static friction or the
// onset on or off. Elongation is the same seen from i and from j; the vector changes its sign.
// With onset located, pairs that nearly touch are stored as well, so that the vector before the contact
// is known.

enum { XI, DX, DY, STATE, SIZE_HISTORY };
static constexpr double STICKS = 0.0, SLIDES = 1.0, NEAR = -1.0;
static constexpr double NEAR_REACH = 1.05;    // in sums of radii

/* ---------------------------------------------------------------------- */

PairLSMFriction::PairLSMFriction(LAMMPS *_lmp) :
    PairLSMFree(_lmp), kt(nullptr), mu(nullptr), mus(nullptr), own_static(nullptr), has_static(0),
    locate_onset(1), fix_dummy(nullptr), fix_history(nullptr)
{
  centroidstressflag = CENTROID_NOTAVAIL;
  nondefault_history_transfer = 1;

  // a contact lost in the step in which the list is built keeps its history until its release was counted

  beyond_contact = 1;
  single_extra = 2;
  svector = new double[2];

  // a second one would take the contact history of the first

  if (modify->get_fix_by_id("NEIGH_HISTORY_LSM_DUMMY") || modify->get_fix_by_id("NEIGH_HISTORY_LSM"))
    error->all(FLERR, "Pair style lsm/friction can be used once only, also under pair_style hybrid; give several "
                      "pair_coeff commands to one");

  // placeholder so that the order of fixes is that of the input script

  fix_dummy = dynamic_cast<FixDummy *>(
      modify->add_fix("NEIGH_HISTORY_LSM_DUMMY all DUMMY"));
}

/* ---------------------------------------------------------------------- */

PairLSMFriction::~PairLSMFriction()
{
  delete[] svector;
  if (!fix_history)
    modify->delete_fix("NEIGH_HISTORY_LSM_DUMMY");
  else
    modify->delete_fix("NEIGH_HISTORY_LSM");
  if (allocated) {
    memory->destroy(kt);
    memory->destroy(mu);
    memory->destroy(mus);
    memory->destroy(own_static);
  }
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (screened) check_special();
  const int choice = (evflag ? 4 : 0) + (record_what ? 2 : 0) + (has_static ? 1 : 0);
  if (locate_onset)
    choose<true>(choice);
  else
    choose<false>(choice);
}

template <bool LOCATE> void PairLSMFriction::choose(int choice)
{
  switch (choice) {
    case 0: return eval<false, false, false, LOCATE>();
    case 1: return eval<false, false, true, LOCATE>();
    case 2: return eval<false, true, false, LOCATE>();
    case 3: return eval<false, true, true, LOCATE>();
    case 4: return eval<true, false, false, LOCATE>();
    case 5: return eval<true, false, true, LOCATE>();
    case 6: return eval<true, true, false, LOCATE>();
    default: return eval<true, true, true, LOCATE>();
  }
}

/* ----------------------------------------------------------------------
   a pair without contact: the vector is kept while it is near, forgotten otherwise
------------------------------------------------------------------------- */

static inline void keep_near(bool near, double delx, double dely, int &touch, double *h)
{
  touch = near ? 1 : 0;
  h[XI] = 0.0;
  h[DX] = near ? delx : 0.0;
  h[DY] = near ? dely : 0.0;
  h[STATE] = near ? NEAR : STICKS;
}

/* ----------------------------------------------------------------------
   The tangential increment is the change of the pair vector since the step before, not velocity times
   time step: ghost velocities need not be communicated, and evaluating the forces twice at the same
   positions (run after run, restart) changes nothing.
------------------------------------------------------------------------- */

template <bool EV, bool RECORD, bool HAS_STATIC, bool LOCATE> void PairLSMFriction::eval()
{
  double **x = atom->x;
  double **f = atom->f;
  const double *radius = atom->radius;
  const int *type = atom->type;
  const int nlocal = atom->nlocal;
  int **firsttouch = fix_history->firstflag;
  double **firsthistory = fix_history->firstvalue;

  // the setup of a run evaluates the forces of a step that was done: the state of the contacts stays, so
  // that a run in pieces equals one run, and a contact that slides goes on sliding. Only where a command moved
  // particles since, by more than they are rounded when they cross a border of the box, their contacts follow.

  const bool setup = update->setupflag != 0;
  double farthest = 0.0;
  for (int c = 0; c < 2; c++)
    farthest = MAX(farthest, MAX(fabs(domain->boxlo[c]), fabs(domain->boxhi[c])));
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * farthest;
  const bool record_slip = RECORD && (record_what & SLIP) && !setup;
  const bool record_contacts = RECORD && (record_what & CONTACTS);
  const double xlo = domain->boxlo[0], lx = domain->prd[0];
  double e_normal = 0.0, e_tangential = 0.0, lost = 0.0;
  if constexpr (RECORD) {
    slip.clear();
    contacts.clear();
  }

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    int *touch = firsttouch[i];
    double *allhistory = firsthistory[i];

    for (int jj = 0; jj < jnum; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      const double delx = x[i][0] - x[j][0];
      const double dely = x[i][1] - x[j][1];
      const double rsq = delx * delx + dely * dely;
      const double r0 = radius[i] + radius[j];
      const bool apart = rsq >= r0 * r0;
      if (apart && !touch[jj] && (!LOCATE || rsq > NEAR_REACH * NEAR_REACH * r0 * r0)) continue;
      if (screened && left_out(jlist[jj], type[i], type[j])) {
        touch[jj] = 0;
        continue;
      }

      double *h = &allhistory[SIZE_HISTORY * jj];
      const bool was_near = touch[jj] && h[STATE] == NEAR;
      if (apart && (!touch[jj] || was_near)) {
        keep_near(LOCATE && rsq <= NEAR_REACH * NEAR_REACH * r0 * r0, delx, dely, touch[jj], h);
        continue;
      }
      const int itype = type[i], jtype = type[j];
      const double r = sqrt(rsq);
      const double rinv = r > 0.0 ? 1.0 / r : 0.0;
      const double nx = delx * rinv, ny = dely * rinv;

      double dxi = 0.0;
      bool moved = !setup;
      if (touch[jj]) {
        if (setup) moved = fabs(delx - h[DX]) > rounding || fabs(dely - h[DY]) > rounding;

        // tangent of the middle of the step, so that the increment is of second order

        const double mx = delx + h[DX], my = dely + h[DY];
        const double msq = mx * mx + my * my;
        const double minv = msq > 0.0 ? 1.0 / sqrt(msq) : 0.0;
        dxi = (my * (h[DX] - delx) + mx * (dely - h[DY])) * minv;
        if (was_near) {
          const double before = sqrt(h[DX] * h[DX] + h[DY] * h[DY]);
          dxi *= LOCATE ? LSM::share_in_contact(before, r, r0) : 0.0;
          h[STATE] = STICKS;
        }
      } else {
        touch[jj] = 1;
        h[XI] = 0.0;
        h[STATE] = STICKS;
      }

      const double kij = k[itype][jtype];
      const double fn = LSM::contact_normal_force(kij, r, r0);
      const LSM::FrictionCoefficients c{kt[itype][jtype], mu[itype][jtype], mus[itype][jtype]};
      bool sliding = false;
      if constexpr (HAS_STATIC) sliding = h[STATE] == SLIDES;
      const LSM::FrictionStep s = !moved && !apart
          ? LSM::FrictionStep{h[XI], c.k_t * h[XI], 0.0, 0.0, sliding}
          : LSM::friction_step<HAS_STATIC>(c, h[XI], dxi, fn, sliding);

      const bool both = newton_pair || j < nlocal;
      if constexpr (RECORD) {
        const double share = both ? 1.0 : 0.5;
        e_normal += share * (apart ? 0.0 : LSM::Spring::energy(kij, r - r0));
        e_tangential += share * LSM::Spring::energy(c.k_t, s.xi);
        if (!setup) lost += share * s.dissipated;
        if (record_slip && s.slip != 0.0) {
          double along = (0.5 * (x[i][0] + x[j][0]) - xlo) / lx;
          along = (along - floor(along)) * lx;
          slip.push_back({floor(along / slip_bin),
                          share * fabs(s.slip) * LSM::contact_size(radius[i], radius[j])});
        }
        if (record_contacts) {
          const double fx = apart ? 0.0 : fn * nx + s.force * ny;
          contacts.push_back({0.5 * (x[i][0] + x[j][0]), -s.slip * fabs(ny), s.dissipated,
                              ny > 0.0 ? -fx : fx, share});
        }
      }

      if (apart) {
        keep_near(LOCATE && rsq <= NEAR_REACH * NEAR_REACH * r0 * r0, delx, dely, touch[jj], h);
        continue;
      }
      h[XI] = s.xi;
      h[DX] = delx;
      h[DY] = dely;
      if constexpr (HAS_STATIC) h[STATE] = s.sliding ? SLIDES : STICKS;

      const double fx = fn * nx + s.force * ny;
      const double fy = fn * ny - s.force * nx;
      f[i][0] += fx;
      f[i][1] += fy;
      if (both) {
        f[j][0] -= fx;
        f[j][1] -= fy;
      }
      if constexpr (EV)
        ev_tally_xyz(i, j, nlocal, newton_pair,
                     LSM::Spring::energy(kij, r - r0) + LSM::Spring::energy(c.k_t, s.xi), 0.0, fx,
                     fy, 0.0, delx, dely, 0.0);
    }
  }
  if constexpr (RECORD) {
    pe_contact = e_normal;
    pe_tangential = e_tangential;
    work_friction += lost;
  }
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::allocate()
{
  PairLSMFree::allocate();
  const int n = atom->ntypes + 1;
  memory->create(kt, n, n, "pair:kt");
  memory->create(mu, n, n, "pair:mu");
  memory->create(mus, n, n, "pair:mus");
  memory->create(own_static, n, n, "pair:own_static");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      kt[i][j] = mu[i][j] = mus[i][j] = 0.0;
      own_static[i][j] = 0;
    }
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::settings(int narg, char **arg)
{
  locate_onset = 1;
  if (narg == 0) return;
  if (narg != 2 || strcmp(arg[0], "onset") != 0)
    error->all(FLERR, "Pair style lsm/friction expects no arguments or 'onset located|step', got '{}'", arg[0]);
  if (strcmp(arg[1], "step") == 0)
    locate_onset = 0;
  else if (strcmp(arg[1], "located") != 0)
    error->all(FLERR, "Pair lsm/friction onset is '{}', but must be located or step", arg[1]);
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::coeff(int narg, char **arg)
{
  if (narg != 3 && narg != 5 && narg != 6)
    error->all(FLERR, "Pair style lsm/friction expects 'pair_coeff I J k kt mu [mu_static]' or "
                      "'pair_coeff I J off'");
  if (!allocated) allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  if (parse_off(narg, arg, ilo, ihi, jlo, jhi)) return;
  if (narg == 3)
    error->all(FLERR, "Pair style lsm/friction expects 'off' or 'k kt mu [mu_static]', got '{}'",
               arg[2]);

  const double k_one = utils::numeric(FLERR, arg[2], false, lmp);
  const double kt_one = utils::numeric(FLERR, arg[3], false, lmp);
  const double mu_one = utils::numeric(FLERR, arg[4], false, lmp);
  const double mus_one = narg == 6 ? utils::numeric(FLERR, arg[5], false, lmp) : mu_one;
  if (k_one <= 0.0) error->all(FLERR, "Pair lsm/friction k is {}, but must be > 0", k_one);
  if (kt_one <= 0.0) error->all(FLERR, "Pair lsm/friction kt is {}, but must be > 0", kt_one);
  if (mu_one < 0.0) error->all(FLERR, "Pair lsm/friction mu is {}, but must be >= 0", mu_one);
  if (mus_one < mu_one)
    error->all(FLERR, "Pair lsm/friction mu_static is {}, but must be at least mu = {}", mus_one,
               mu_one);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      k[i][j] = k_one;
      kt[i][j] = kt_one;
      mu[i][j] = mu_one;
      mus[i][j] = mus_one;
      own_static[i][j] = narg == 6;
      on[i][j] = setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR, "Pair lsm/friction: pair_coeff {} {} names no pair of types", arg[0], arg[1]);
}

/* ---------------------------------------------------------------------- */

int PairLSMFriction::request_flags() const
{
  return NeighConst::REQ_SIZE | NeighConst::REQ_HISTORY;
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::init_style()
{
  if (domain->dimension != 2)
    error->all(FLERR, "Pair style lsm/friction needs a 2-dimensional simulation (dimension 2)");

  has_static = 0;    // see init_one()
  PairLSMFree::init_style();

  // the history of a pair is found by the IDs of its particles

  if (update->whichflag) {
    double reach = 0.0;
    for (int i = 1; i <= atom->ntypes; i++)
      for (int j = i; j <= atom->ntypes; j++)
        if (on[i][j]) reach = MAX(reach, maxrad[i] + maxrad[j] + neighbor->skin);
    for (int c = 0; c < 2; c++)
      if (domain->periodicity[c] && domain->prd[c] < 2.0 * reach)
        error->all(FLERR,
                   "Pair style lsm/friction: the period of the box in {} is {:.6g}, but must be at least {:.6g} (twice the "
                   "largest contact distance with the neighbor skin), as a pair would meet itself on both sides",
                   c ? "y" : "x", domain->prd[c], 2.0 * reach);
  }

  // one name, whichever styles came before, so that a restart finds the history

  const std::string id_history = "NEIGH_HISTORY_LSM";
  if (!fix_history) {
    fix_history = dynamic_cast<FixNeighHistory *>(
        modify->replace_fix("NEIGH_HISTORY_LSM_DUMMY",
                            id_history + " all LSM_HISTORY " + std::to_string(SIZE_HISTORY), 1));
    fix_history->pair = this;
  } else {
    fix_history = dynamic_cast<FixNeighHistory *>(modify->get_fix_by_id(id_history));
    if (!fix_history) error->all(FLERR, "Could not find the contact history of pair lsm/friction");
  }
}

/* ---------------------------------------------------------------------- */

double PairLSMFriction::init_one(int i, int j)
{
  const double cut = PairLSMFree::init_one(i, j);
  kt[j][i] = kt[i][j];
  mu[j][i] = mu[i][j];

  // fix adapt changes mu and comes here again

  if (!own_static[i][j]) mus[i][j] = mu[i][j];
  if (on[i][j] && mus[i][j] < mu[i][j])
    error->all(FLERR, "Pair lsm/friction mu of types {} {} became {}, but must be at most mu_static = {}", i, j,
               mu[i][j], mus[i][j]);
  if (on[i][j] && mus[i][j] > mu[i][j]) has_static = 1;
  mus[j][i] = mus[i][j];
  return cut;
}

/* ----------------------------------------------------------------------
   history of the pair as seen from the other particle
------------------------------------------------------------------------- */

void PairLSMFriction::transfer_history(double *source, double *target, int, int)
{
  target[XI] = source[XI];
  target[DX] = -source[DX];
  target[DY] = -source[DY];
  target[STATE] = source[STATE];
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::write_coeff(FILE *fp, int i, int j)
{
  PairLSMFree::write_coeff(fp, i, j);
  fwrite(&kt[i][j], sizeof(double), 1, fp);
  fwrite(&mu[i][j], sizeof(double), 1, fp);
  fwrite(&mus[i][j], sizeof(double), 1, fp);
}

void PairLSMFriction::read_coeff(FILE *fp, int i, int j)
{
  PairLSMFree::read_coeff(fp, i, j);
  for (double *value : {&kt[i][j], &mu[i][j], &mus[i][j]}) {
    if (comm->me == 0) utils::sfread(FLERR, value, sizeof(double), 1, fp, nullptr, error);
    MPI_Bcast(value, 1, MPI_DOUBLE, 0, world);
  }
  own_static[i][j] = mus[i][j] > mu[i][j];
}

void PairLSMFriction::print_coeff(FILE *fp, int i, int j)
{
  fprintf(fp, " %.17g %.17g %.17g %.17g", k[i][j], kt[i][j], mu[i][j], mus[i][j]);
}

/* ----------------------------------------------------------------------
   normal force and energy of both springs; svector = elongation of the tangential spring and the
   tangential force on i along (-ny,nx)
------------------------------------------------------------------------- */

double PairLSMFriction::single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                               double factor_lj, double &fforce)
{
  double energy =
      PairLSMFree::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  svector[0] = svector[1] = 0.0;
  if (fforce == 0.0) return energy;

  const int lo = MIN(itype, jtype), hi = MAX(itype, jtype);
  const int *jlist = list->firstneigh[i];
  for (int jj = 0; jj < list->numneigh[i]; jj++)
    if ((jlist[jj] & NEIGHMASK) == j) {
      svector[0] = fix_history->firstvalue[i][SIZE_HISTORY * jj + XI];
      svector[1] = -kt[lo][hi] * svector[0];
      energy += LSM::Spring::energy(kt[lo][hi], svector[0]);
      break;
    }
  return energy;
}

/* ---------------------------------------------------------------------- */

void *PairLSMFriction::extract(const char *str, int &dim)
{
  dim = 2;
  if (strcmp(str, "kt") == 0) return (void *) kt;
  if (strcmp(str, "mu") == 0) return (void *) mu;
  return PairLSMFree::extract(str, dim);
}
