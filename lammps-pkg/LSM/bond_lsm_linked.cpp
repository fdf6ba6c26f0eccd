/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "bond_lsm_linked.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include "lsm_force_laws.h"
#include "lsm_link_kernel.h"
#include "lsm_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

using namespace LAMMPS_NS;

static constexpr double BROKEN =
    -1.0;    // in place of a rest length, until the list is collected anew

/* ---------------------------------------------------------------------- */

BondLSMLinked::BondLSMLinked(LAMMPS *_lmp) :
    Bond(_lmp), k(nullptr), ratio(nullptr), breakable(0), maxrad(0.0), collected_at(-1)
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
  if (collected_at != neighbor->lastcall) collect();
  domain->dimension == 3 ? eval<3>() : eval<2>();
  if (evflag) tally();
}

/* ----------------------------------------------------------------------
   The links of this rank in an order that follows from the particle IDs alone: a run that goes on from a
   restart file sums in the same order, and links that follow each other touch the same stretch of memory if
   IDs follow the particles in space. Links that are treated differently stand in segments of their own:
   by type, and by whether the force on the second particle is added here.
   With newton_bond off the first particle of a link is always owned, and a link to a ghost stands in the
   list of both ranks: half of its energy is counted on each.
------------------------------------------------------------------------- */

void BondLSMLinked::collect()
{
  struct Link {
    bool first_only;
    int type;
    tagint low, high, first;
    int i, j;
    bool operator<(const Link &o) const
    {
      return std::tie(first_only, type, low, high, first) <
             std::tie(o.first_only, o.type, o.low, o.high, o.first);
    }
  };

  const tagint *const tag = atom->tag;
  int **const bondlist = neighbor->bondlist;
  std::vector<Link> links;
  links.reserve(neighbor->nbondlist);
  for (int n = 0; n < neighbor->nbondlist; n++) {
    const int i = bondlist[n][0], j = bondlist[n][1], type = bondlist[n][2];
    if (type > 0)
      links.push_back({!force->newton_bond && j >= atom->nlocal, type, MIN(tag[i], tag[j]),
                       MAX(tag[i], tag[j]), tag[i], i, j});
  }
  std::sort(links.begin(), links.end());

  ends.clear();
  rest.clear();
  segments.clear();
  for (const Link &link : links) {
    const int n = static_cast<int>(rest.size());
    if (segments.empty() || segments.back().type != link.type ||
        segments.back().first_only != link.first_only)
      segments.push_back({n, n, link.type, link.first_only});
    segments.back().last = n + 1;
    ends.push_back({3 * link.i, 3 * link.j});
    rest.push_back(atom->radius[link.i] + atom->radius[link.j]);
  }
  list_to_fetch();
  collected_at = neighbor->lastcall;
}

/* ----------------------------------------------------------------------
   Particles whose place in memory a block of links needs and the blocks shortly before did not: fetched while
   the block before is worked on, as the time to fetch them one by one when they are needed would be longer
   than all arithmetic.
------------------------------------------------------------------------- */

void BondLSMLinked::list_to_fetch()
{
  constexpr int REMEMBERED =
      16;                    // blocks whose particles are taken to be in the nearest cache still
  constexpr int LINE = 8;    // doubles of a cache line

  to_fetch.clear();
  to_fetch_begin = {0};
  std::vector<int> used(3 * (atom->nlocal + atom->nghost) / LINE + 1, -REMEMBERED - 1);
  int number = 0;
  for (const Segment &segment : segments)
    for (int first = segment.first; first < segment.last; first += LSMLinkKernel::BLOCK, number++) {
      const int last = MIN(first + LSMLinkKernel::BLOCK, segment.last);
      for (int n = first; n < last; n++)
        for (const int place : {ends[n].i, ends[n].j}) {
          if (number - used[place / LINE] > REMEMBERED) to_fetch.push_back(place);
          used[place / LINE] = number;
        }
      to_fetch_begin.push_back(static_cast<int>(to_fetch.size()));
    }
}

/* ---------------------------------------------------------------------- */

template <int DIM> void BondLSMLinked::eval()
{
  pe_link = 0.0;
  if (rest.empty()) return;

  // a minimizer tries positions that it takes back

  const bool minimizing = update->whichflag == 2;
  const int *begin = to_fetch_begin.data();
  for (const Segment &s : segments) {
    const LSMLinkKernel::Links links{&ends[s.first], &rest[s.first], s.last - s.first, k[s.type],
                                     ratio[s.type],  s.first_only,   to_fetch.data(),  begin};
    begin += (links.count + LSMLinkKernel::BLOCK - 1) / LSMLinkKernel::BLOCK;
    if (ratio[s.type] > 0.0 && !minimizing) {
      broken_now.clear();
      pe_link += LSMLinkKernel::forces<DIM, true>(links, atom->x[0], atom->f[0], broken_now);
      note_broken(s);
    } else
      pe_link += LSMLinkKernel::forces<DIM, false>(links, atom->x[0], atom->f[0], broken_now);
  }
}

/* ----------------------------------------------------------------------
   Broken links are noted for fix LSM_BREAK; before the forces are evaluated again the list is collected
   without them.
------------------------------------------------------------------------- */

void BondLSMLinked::note_broken(const Segment &segment)
{
  for (const int n : broken_now) {
    const int i = ends[segment.first + n].i / 3, j = ends[segment.first + n].j / 3;
    for (int m = 0; m < neighbor->nbondlist; m++)
      if (neighbor->bondlist[m][0] == i && neighbor->bondlist[m][1] == j)
        neighbor->bondlist[m][2] = 0;
    broken.push_back(atom->tag[i]);
    broken.push_back(atom->tag[j]);
    broken.push_back(segment.type);
    rest[segment.first + n] = BROKEN;
    if (record_what) {
      double **x = atom->x, none;
      const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
      work_broken += (segment.first_only ? 0.5 : 1.0) *
                     single(segment.type, dx * dx + dy * dy + dz * dz, i, j, none);
    }
    collected_at = -1;
  }
}

/* ----------------------------------------------------------------------
   energy and virial for LAMMPS, in steps that ask for them
------------------------------------------------------------------------- */

void BondLSMLinked::tally()
{
  double **x = atom->x;
  for (int n = 0; n < neighbor->nbondlist; n++) {
    const int i = neighbor->bondlist[n][0], j = neighbor->bondlist[n][1];
    const int type = neighbor->bondlist[n][2];
    if (type <= 0) continue;
    const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
    double fbond = 0.0;
    const double energy = single(type, dx * dx + dy * dy + dz * dz, i, j, fbond);
    ev_tally(i, j, atom->nlocal, force->newton_bond, energy, fbond, dx, dy, dz);
  }
}

/* ---------------------------------------------------------------------- */

double BondLSMLinked::max_strain() const
{
  double **x = atom->x;
  double worst = 0.0;
  for (size_t n = 0; n < rest.size(); n++) {
    if (rest[n] == BROKEN) continue;
    const int i = ends[n].i / 3, j = ends[n].j / 3;
    const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
    const double strain = fabs(sqrt(dx * dx + dy * dy + dz * dz) - rest[n]) / rest[n];
    if (!(strain <= worst)) worst = strain;    // a NaN counts as worst
  }
  return worst;
}

/* ---------------------------------------------------------------------- */

std::vector<BondLSMLinked::Held> BondLSMLinked::held() const
{
  std::vector<Held> all;
  all.reserve(rest.size());
  for (const Segment &s : segments)
    for (int n = s.first; n < s.last; n++)
      if (rest[n] != BROKEN) all.push_back({ends[n].i / 3, ends[n].j / 3, k[s.type]});
  return all;
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
    error->all(FLERR,
               "Bond style lsm/linked needs particle radii: use atom_style hybrid bond sphere");
  LSMScene::refuse_changing_radii(lmp, "Bond style lsm/linked");
  for (const char *makes_or_breaks : {"^bond/break", "^bond/create", "^bond/react", "^bond/swap"})
    for (const auto &other : modify->get_fix_by_style(makes_or_breaks))
      error->all(
          FLERR,
          "Bond style lsm/linked does not work with fix {} of style {}, as nobody would count "
          "the energy of its bonds; let links break by the ratio of bond_coeff",
          other->id, other->style);
  collected_at = -1;

  double mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, atom->radius[i]);
  MPI_Allreduce(&mine, &maxrad, 1, MPI_DOUBLE, MPI_MAX, world);

  // only links that can break need the fix that tells the other ranks and updates the topology

  if (breakable && !modify->get_fix_by_id("LSM_BREAK")) modify->add_fix("LSM_BREAK all LSM_BREAK");
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
