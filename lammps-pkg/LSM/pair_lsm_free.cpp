// SPDX-License-Identifier: GPL-2.0-or-later

#include "pair_lsm_free.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "update.h"

#include "friction/force_laws.h"
#include "friction/friction_contact.h"
#include "lsm_contact_recorder.h"
#include "lsm_fixes.h"
#include "lsm_keyword_reader.h"
#include "lsm_restart_file.h"
#include "lsm_scene.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

PairLSMFree::PairLSMFree(LAMMPS *_lmp) : Pair(_lmp), request_flags(NeighConst::REQ_SIZE), near(_lmp)
{
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  writedata = 1;
  restartinfo = 1;
}

PairLSMFree::~PairLSMFree()
{
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairLSMFree::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (screened) check_special();
  near.update(*list, contact_radii(), nullptr);
  if (evflag)
    loop<LSMRecordAndTally>();
  else if (record_what)
    loop<LSMRecordEnergies>();
  else
    loop<LSMRecordNothing>();
}

template <class Recorder> void PairLSMFree::loop()
{
  if (domain->dimension == 3)
    loop<Recorder, 3>();
  else
    loop<Recorder, 2>();
}

template <class Recorder, int DIM> void PairLSMFree::loop()
{
  double **f = atom->f;
  const int nlocal = atom->nlocal;
  const bool viscous = has_dashpots();
  Recorder recorder(*this, update->setupflag != 0);

  for (int n = 0; n < near.size(); n++) {
    const LSMContacts::Pair &pair = near.pair(near[n]);
    const double *const d = near.vector(near[n]), r0 = pair.r0;
    const double rsq = LSM::friction_contact::square_of<DIM>(d);
    if (rsq >= r0 * r0) continue;

    const int i = pair.i, j = pair.j;
    const double kij = k.at(pair.types);
    const double r = sqrt(rsq);
    double fpair = r > 0.0 ? -LSM::Spring::force(kij, r - r0) / r : 0.0;
    const bool both = newton_pair || j < nlocal;
    if (viscous && r > 0.0) {
      double rate;
      const double more = dashpot(i, j, r, fpair * r, rate);
      fpair += more / r;
      velocity->power -= (both ? 1.0 : 0.5) * more * rate;
    }

    for (int c = 0; c < DIM; c++) f[i][c] += d[c] * fpair;
    for (int c = 0; both && c < DIM; c++) f[j][c] -= d[c] * fpair;
    if constexpr (Recorder::records) {
      const double e = LSM::Spring::energy(kij, r - r0);
      recorder.springs(both ? 1.0 : 0.5, e, 0.0);
      if constexpr (Recorder::tallies)
        ev_tally(i, j, nlocal, newton_pair, e, 0.0, fpair, d[0], d[1], DIM == 3 ? d[DIM - 1] : 0.0);
    }
  }
  recorder.finish();
}

const double *PairLSMFree::contact_radii() const
{
  return own_radii ? own_radii->contact_radii() : atom->radius;
}

bool PairLSMFree::is_viscous() const
{
  for (int i = 1; allocated && i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (setflag[i][j] && delay[i][j] > 0.0) return true;
  return false;
}

// whether pair_write asks, which knows types and distances only; the next run, or the next piece of
// this one, begins with the same last command
bool PairLSMFree::is_for_table() const
{
  return near.is_empty() && LSMScene::is_command(lmp, "pair_write");
}

// a minimizer has no velocities
bool PairLSMFree::has_dashpots() const
{
  return velocity && update->whichflag != 2;
}

double PairLSMFree::dashpot(int i, int j, double r, double spring, double &rate) const
{
  rate = velocity->rate(i, j, r);
  return LSM::contact_dashpot_force(viscosity(atom->type[i], atom->type[j]), rate, spring);
}

// Checks that linked particles are not contact pairs, and all others are. Under pair_style hybrid
// the factors of a sub-style are known only while it computes.
void PairLSMFree::check_special() const
{
  const double *factor = force->special_lj;
  if (atom->nbonds > 0 && (factor[1] != 0.0 || factor[2] != 1.0 || factor[3] != 1.0))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/*: the special_bonds factors lj are {} {} {}, but must be 0 1 1, so "
               "that linked particles "
               "are no contact pairs and all others are",
               factor[1], factor[2], factor[3]);
}

void PairLSMFree::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  std::fill_n(setflag[0], n * n, 0);
  for (auto *numbers : {&k, &delay}) numbers->create(n);
  for (auto *flags : {&on, &active}) flags->create(n);
}

void PairLSMFree::settings(int narg, char ** /*arg*/)
{
  if (narg != 0)
    error->all(FLERR, "Pair style lsm/free takes no arguments, but {} were given", narg);
}

void PairLSMFree::parse_law(int narg, char ** /*arg*/)
{
  if (narg != 0)
    error->all(FLERR,
               "Pair style lsm/free expects 'pair_coeff I J k [kelvin-voigt TIME]' or "
               "'pair_coeff I J off'");
}

// "pair_coeff I J off": these types never touch; costs nothing per step
void PairLSMFree::coeff(int narg, char **arg)
{
  const std::string who = std::string("Pair style ") + force->pair_match_ptr(this);
  const double delay_one = LSMScene::take_retardation(lmp, who, narg, arg);
  const bool off = narg == 3 && strcmp(arg[2], "off") == 0;
  if (!off) parse_law(narg - 3, arg + 3);
  const double k_one = off ? 0.0 : utils::numeric(FLERR, arg[2], false, lmp);
  if (!off && k_one <= 0.0)
    error->all(FLERR, lsm_place(lmp, arg[2]), "{} k is {}, but must be > 0", who, k_one);
  if (!allocated) allocate();
  LSMScene::set_up_next_run(lmp);

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  if (MAX(jlo, ilo) > jhi)
    error->all(FLERR, lsm_place(lmp, arg[1]), "{}: pair_coeff {} {} names no pair of types I <= J",
               who, arg[0], arg[1]);
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      setflag[i][j] = 1;
      on[i][j] = !off;
      if (off) continue;
      k[i][j] = k_one;
      delay[i][j] = delay_one;
      set_law(i, j);
    }
}

void PairLSMFree::init_style()
{
  if (!atom->radius_flag)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/* needs particle radii: use atom_style hybrid bond sphere");
  LSMScene::set_up_next_run(lmp);
  velocity = is_viscous() ? FixLSMVelocity::of(lmp) : nullptr;
  const auto others = lsm_fixes<LSMContactRadii>(modify);
  own_radii = others.empty() ? nullptr : others.front();
  newton_pair = force->newton_pair;
  LSMScene::refuse_changing_radii(lmp, "Pair style lsm/*");
  if (utils::strmatch(force->pair_style, "^hybrid/scaled"))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair style lsm/* does not work under hybrid/scaled, as recorded energies "
               "and the time-step check "
               "would not be scaled; use pair_style hybrid or hybrid/overlay");
  if (update->whichflag && (!compute_flag || !force->pair->compute_flag))
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair style lsm/* does not work with pair_modify compute no; use 'pair_coeff I J off'");

  // the list of a sub-style of hybrid may hold pairs of other sub-styles; with charges, linked
  // pairs stay in the list, too
  const bool under_hybrid = force->pair != this;
  screened = under_hybrid ||
      (atom->nbonds > 0 && (force->special_coul[1] != 0.0 || force->kspace != nullptr));
  near.init(active, screened, *this);
  if (update->whichflag) {
    if (!under_hybrid) check_special();
    if (LSMScene::contact_styles(force).front() == this) warn_of_missing_links();
  }

  // hybrid calls init_one() for the pairs of types that it assigns to this style. It does not for
  // those with 'none', which it leaves in the list if each type with itself belongs to this style.
  const int ntypes = atom->ntypes;
  active.create(ntypes + 1);
  find_largest_radii();

  // types that never touch are left out when the list is built; under hybrid this request would be
  // replaced
  auto request = neighbor->add_request(this, request_flags);
  if (under_hybrid) return;
  int any_off = 0;
  for (int i = 1; i <= ntypes; i++)
    for (int j = i; j <= ntypes; j++)
      if (setflag[i][j] && !on[i][j]) any_off = 1;
  if (any_off) {
    auto iskip = new int[ntypes + 1];
    int **ijskip;
    memory->create(ijskip, ntypes + 1, ntypes + 1, "pair:ijskip");
    for (int i = 1; i <= ntypes; i++) {
      iskip[i] = 1;
      for (int j = 1; j <= ntypes; j++) {
        ijskip[i][j] = on[MIN(i, j)][MAX(i, j)] ? 0 : 1;
        if (!ijskip[i][j]) iskip[i] = 0;
      }
    }
    request->set_skip(iskip, ijskip);    // the request owns both from here on
  }
}

void PairLSMFree::find_largest_radii()
{
  const int ntypes = atom->ntypes;
  std::vector<double> mine(ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    mine[atom->type[i]] = MAX(mine[atom->type[i]], atom->radius[i]);

  // particles that will be inserted during the run
  for (const char *style : {"^pour", "^deposit"})
    for (const auto &source : modify->get_fix_by_style(style))
      for (int i = 1; i <= ntypes; i++) {
        int itype = i;
        const auto radius = (const double *) source->extract("radius", itype);
        if (radius) mine[i] = MAX(mine[i], *radius);
      }
  maxrad.resize(mine.size());
  MPI_Allreduce(mine.data(), maxrad.data(), ntypes + 1, MPI_DOUBLE, MPI_MAX, world);
}

// A pair whose link was turned off or removed without its entry among the special neighbors neither
// holds together nor touches.
void PairLSMFree::warn_of_missing_links() const
{
  if (atom->molecular != Atom::MOLECULAR || !atom->nspecial) return;
  bigint mine[2] = {0, 0}, all[2];    // particles among the 1-2 neighbors of others, ends of links
  for (int i = 0; i < atom->nlocal; i++) {
    mine[0] += atom->nspecial[i][0];
    for (int m = 0; m < atom->num_bond[i]; m++)
      if (atom->bond_type[i][m] > 0) mine[1] += force->newton_bond ? 2 : 1;
  }
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (comm->me == 0 && all[0] > all[1])
    error->warning(FLERR,
                   "Pair style lsm/*: {} pairs of particles have no link but are kept from "
                   "touching as if linked; use 'delete_bonds ... remove special'",
                   (all[0] - all[1]) / 2);
}

double PairLSMFree::init_one(int i, int j)
{
  if (setflag[i][j] == 0)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair lsm/*: coefficients of types {} {} are not set; use 'off' for types that never touch",
        i, j);
  if (on[i][j] && !(k[i][j] > 0.0))
    error->all(FLERR, Error::NOLASTLINE, "Pair lsm/*: k of types {} {} is {}, but must be > 0", i,
               j, k[i][j]);
  k[j][i] = k[i][j];
  delay[j][i] = delay[i][j];
  on[j][i] = active[i][j] = active[j][i] = on[i][j];
  return maxrad[i] + maxrad[j];
}

void PairLSMFree::coefficients_in(LSMRestartFile file)
{
  const int n = atom->ntypes;
  for (int i = 1; i <= n; i++)
    for (int j = i; j <= n; j++) {
      file(setflag[i][j]);
      if (!setflag[i][j]) continue;
      file(on[i][j], k[i][j], delay[i][j]);
      keep_law(file, i, j);
    }
}

void PairLSMFree::write_restart_settings(FILE *fp)
{
  LSMRestartFile(lmp, fp, false).version();
}

void PairLSMFree::read_restart_settings(FILE *fp)
{
  LSMRestartFile(lmp, fp, true).version();
}

void PairLSMFree::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  coefficients_in({lmp, fp, false});
}

void PairLSMFree::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  coefficients_in({lmp, fp, true});
}

void PairLSMFree::print_coeff(FILE *fp, int i, int j)
{
  if (on[i][j]) {
    fprintf(fp, " %.17g", k[i][j]);
    print_law(fp, i, j);
    if (delay[i][j] > 0.0) fprintf(fp, " kelvin-voigt %.17g", delay[i][j]);
  } else
    fputs(" off", fp);
  fputs("\n", fp);
}

void PairLSMFree::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) {
    fprintf(fp, "%d", i);
    print_coeff(fp, i, i);
  }
}

void PairLSMFree::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fprintf(fp, "%d %d", i, j);
      print_coeff(fp, i, j);
    }
}

double PairLSMFree::single(int i, int j, int itype, int jtype, double rsq, double /*factor_coul*/,
                           double /*factor_lj*/, double &fforce)
{
  fforce = 0.0;
  const double r = sqrt(rsq);
  const double r0 = is_for_table() ? maxrad[itype] + maxrad[jtype]
                                   : contact_radii()[i] + contact_radii()[j];
  const int lo = MIN(itype, jtype), hi = MAX(itype, jtype);
  if (!active[lo][hi] || r >= r0 || r == 0.0) return 0.0;
  double push = -LSM::Spring::force(k[lo][hi], r - r0), rate;
  if (has_dashpots() && !is_for_table())
    push += dashpot(i, domain->closest_image(i, j), r, push, rate);
  fforce = push / r;
  return LSM::Spring::energy(k[lo][hi], r - r0);
}

void *PairLSMFree::extract(const char *str, int &dim)
{
  dim = 2;
  if (strcmp(str, "k") == 0) return k.data();
  dim = 1;    // so that fix adapt, which writes numbers, refuses it
  return strcmp(str, "on") == 0 ? active.data() : nullptr;
}
