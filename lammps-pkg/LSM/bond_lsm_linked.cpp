// SPDX-License-Identifier: GPL-2.0-or-later

#include "bond_lsm_linked.h"

#include "atom.h"
#include "citeme.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include "files/text.h"
#include "friction/force_laws.h"
#include "lsm_keyword_reader.h"
#include "lsm_link_kernel.h"
#include "lsm_ranks.h"
#include "lsm_restart_file.h"
#include "lsm_scene.h"
#include "lsm_version.h"
#include "numerics/sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

struct BondLSMLinked::Segment {
  int type;
  bool first_only;    // the force on the second particle is added by its owner
  LSMLinkRows::Rows rows;
  LSM::NeumaierSum energy;
};

static const char cite_lsm[] =
    "Lattice solid fault (package LSM " LSM_VERSION "): doi:10.5194/npg-11-553-2004\n\n"
    "@Article{Weatherley2004,\n"
    " author =  {Weatherley, D. and Abe, S.},\n"
    " title =   {Earthquake statistics in a Block Slider Model and a fully dynamic Fault Model},\n"
    " journal = {Nonlinear Processes in Geophysics},\n"
    " year =    2004,\n"
    " volume =  11,\n"
    " pages =   {553}\n"
    "}\n\n";

BondLSMLinked::BondLSMLinked(LAMMPS *_lmp) : Bond(_lmp), avx2(LSMLinkKernel::has_avx2())
{
  if (lmp->citeme) lmp->citeme->add(cite_lsm);
  writedata = 1;
}

BondLSMLinked::~BondLSMLinked()
{
  if (modify && modify->get_fix_by_id("LSM_BREAK")) modify->delete_fix("LSM_BREAK");
  if (allocated) memory->destroy(setflag);
}

void BondLSMLinked::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (collected_at != neighbor->lastcall) collect();
  domain->dimension == 3 ? eval<3>() : eval<2>();
  if (evflag) tally();
}

// Returns the indices that sort the elements by their keys; equal keys keep their order. A radix
// sort, which takes a fraction of the time of a sort by comparisons.
template <class Element, class Key>
static std::vector<int> sorted_by(const std::vector<Element> &elements, const Key &key)
{
  constexpr int BITS = 11;
  std::vector<int> order(elements.size()), next(elements.size());
  std::vector<tagint> keys;
  keys.reserve(elements.size());
  for (const Element &one : elements) keys.push_back(key(one));
  std::iota(order.begin(), order.end(), 0);
  tagint most = keys.empty() ? 0 : *std::max_element(keys.begin(), keys.end());
  for (int shift = 0; most > 0; shift += BITS, most >>= BITS) {
    const auto digit = [&](int n) {
      return keys[n] >> shift & ((1 << BITS) - 1);
    };
    std::vector<int> begin((1 << BITS) + 1, 0);
    for (int n : order) begin[digit(n) + 1]++;
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (int n : order) next[begin[digit(n)]++] = n;
    order.swap(next);
  }
  return order;
}

// Arranges the links of this rank in rows. Their order follows from the particle IDs alone, so that
// a run that continues from a restart file sums in the same order, and so that successive links use
// the same stretch of memory if IDs follow the particles in space. Links are divided into segments
// by type and by whether the force on the second particle is added here. With newton_bond off the
// first particle of a link is always owned, and a link to a ghost is in the list of both ranks,
// each of which counts half of its energy.
void BondLSMLinked::collect()
{
  struct Ends {
    int i, j;
  };

  const tagint *const tag = atom->tag;
  const int nlocal = atom->nlocal;
  int **const bondlist = neighbor->bondlist;
  const int types = atom->nbondtypes;
  const auto kind_of = [&](const int *bond) {
    return bond[2] - 1 + (!force->newton_bond && bond[1] >= nlocal ? types : 0);
  };
  // a list at a time, of the size that it needs: a lattice has nine links per node
  std::vector<std::vector<Ends>> kinds(2 * types);
  std::vector<std::size_t> count(2 * types, 0);
  for (int n = 0; n < neighbor->nbondlist; n++)
    if (bondlist[n][2] > 0) count[kind_of(bondlist[n])]++;
  for (int kind = 0; kind < 2 * types; kind++) kinds[kind].reserve(count[kind]);
  for (int n = 0; n < neighbor->nbondlist; n++) {
    int i = bondlist[n][0], j = bondlist[n][1];
    if (bondlist[n][2] <= 0) continue;
    const int kind = kind_of(bondlist[n]);
    if (j < nlocal && tag[j] < tag[i]) std::swap(i, j);
    kinds[kind].push_back({i, j});
  }

  const std::vector<int> owned = owned_by_id();
  const double *const radius = atom->radius;
  segments.clear();
  for (int kind = 0; kind < 2 * types; kind++) {
    std::vector<Ends> &links = kinds[kind];
    if (links.empty()) continue;
    const bool first_only = kind >= types;
    const int type = 1 + kind % types;
    const auto low = [tag](const Ends &link) {
      return MIN(tag[link.i], tag[link.j]);
    };
    std::vector<int> order = sorted_by(links, low);
    for (auto begin = order.begin(); begin != order.end();) {
      const auto end = std::find_if(begin, order.end(), [&, of = low(links[*begin])](int n) {
        return low(links[n]) != of;
      });
      std::sort(begin, end, [&](int a, int b) {
        const auto key = [&](const Ends &link) {
          return std::make_pair(MAX(tag[link.i], tag[link.j]), tag[link.i]);
        };
        return key(links[a]) < key(links[b]);
      });
      begin = end;
    }
    std::vector<LSMLinkRows::Link> sorted;
    sorted.reserve(order.size());
    for (int n : order)
      sorted.push_back(
          {links[n].i, links[n].j, factor[type] * (radius[links[n].i] + radius[links[n].j])});
    std::vector<Ends>().swap(links);
    std::vector<int>().swap(order);
    segments.push_back(
        {type,
         first_only,
         LSMLinkRows::make_rows(owned, std::move(sorted), nlocal, nlocal + atom->nghost, first_only,
                                ratio[type] == 0.0, stride(type), domain->dimension == 3),
         {}});
  }
  collected_at = neighbor->lastcall;
}

std::vector<int> BondLSMLinked::owned_by_id() const
{
  const tagint *const tag = atom->tag;
  std::vector<int> owned(atom->nlocal);
  std::iota(owned.begin(), owned.end(), 0);
  if (!std::is_sorted(tag, tag + atom->nlocal))
    std::sort(owned.begin(), owned.end(), [tag](int i, int j) {
      return tag[i] < tag[j];
    });
  return owned;
}

// In three dimensions a window of particles at a time gets the forces of links of all types, while
// it is in the cache: blocks of several types of links are larger than that.
template <int DIM> void BondLSMLinked::eval()
{
  // a minimizer may reject positions that it tried, so that breaking a link would be premature
  const bool minimizing = update->whichflag == 2;
  const int windows = segments.empty() ? 0 : static_cast<int>(segments[0].rows.windows.size()) - 1;
  const int step = DIM == 3 ? 1 : windows;
  for (Segment &s : segments) s.energy = {};
  for (int from = 0; from < windows; from += step)
    for (Segment &s : segments) {
      const LSMLinkKernel::Windows some{from, from + step};
      if (ratio[s.type] > 0.0 && !minimizing) {
        broken_now.clear();
        s.energy.add(forces_of<DIM>(s, some, LSMLinkKernel::Breakable{{k[s.type]}, ratio[s.type]}));
        note_broken(s);
      } else
        s.energy.add(forces_of<DIM>(s, some, LSMLinkKernel::Elastic{k[s.type]}));
    }
  pe_link = 0.0;
  for (const Segment &s : segments) pe_link += s.energy.value();
}

template <int DIM, class Law>
double BondLSMLinked::forces_of(const Segment &s, LSMLinkKernel::Windows windows, const Law &law)
{
  const auto add = [&](const auto &any) {
    return LSMLinkKernel::forces<DIM>(s.rows, windows, any, s.first_only, atom->x[0], atom->f[0],
                                      broken_now, avx2);
  };
  if (!has_dashpot(s.type)) return add(law);
  return add(LSMLinkKernel::KelvinVoigt<Law>{law, k[s.type] * delay[s.type], &velocity->power,
                                             velocity->now(0)});
}

// the numbers of a particle in the array that the kernel reads
int BondLSMLinked::stride(int type) const
{
  if (!has_dashpot(type)) return 3;
  return domain->dimension == 3 ? LSMLinkKernel::Motion<3>::SIZE : LSMLinkKernel::Motion<2>::SIZE;
}

// Broken links are listed for fix LSM_BREAK; before the next evaluation of the forces the list is
// collected without them.
void BondLSMLinked::note_broken(Segment &segment)
{
  for (const LSMLinkRows::Found &link : broken_now) {
    const int i = link.i, j = link.j;
    for (int m = 0; m < neighbor->nbondlist; m++) {
      int *const bond = neighbor->bondlist[m];
      if (bond[2] == segment.type && MIN(bond[0], bond[1]) == MIN(i, j) &&
          MAX(bond[0], bond[1]) == MAX(i, j))
        bond[2] = 0;
    }
    broken.push_back(atom->tag[i]);
    broken.push_back(atom->tag[j]);
    broken.push_back(segment.type);
    segment.rows.rest[link.rest] = LSMLinkRows::NO_LINK;
    double none;
    if (record_what)
      work_broken += (segment.first_only ? 0.5 : 1.0) *
          single(segment.type, MathExtra::distsq3(atom->x[i], atom->x[j]), i, j, none);
    collected_at = -1;
  }
}

// energy and virial for LAMMPS, in steps that ask for them
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

template <class Act> void BondLSMLinked::for_each_link(const Act &act) const
{
  using LSMLinkRows::LANES;
  for (const Segment &s : segments)
    for (const LSMLinkRows::Stack &stack : s.rows.stacks)
      for (int n = 0; n < stack.slices * stack.length * LANES; n++) {
        const LSMLinkRows::Found link = s.rows.link(stack, n);
        const double rest = s.rows.rest[link.rest];
        if (rest != LSMLinkRows::NO_LINK) act(s, link.i, link.j, rest);
      }
}

double BondLSMLinked::max_strain() const
{
  double worst = 0.0;
  for_each_link([&](const Segment &, int i, int j, double rest) {
    const double strain = fabs(sqrt(MathExtra::distsq3(atom->x[i], atom->x[j])) - rest) / rest;
    if (!(strain <= worst)) worst = strain;    // a NaN counts as worst
  });
  return worst;
}

void BondLSMLinked::for_each_current(const std::function<void(const CurrentLink &)> &act) const
{
  for_each_link([&](const Segment &s, int i, int j, double) {
    act({i, j, k[s.type], k[s.type] * delay[s.type]});
  });
}

static bool any_above_0(const std::vector<double> &of_types)
{
  return std::any_of(of_types.begin(), of_types.end(), [](double value) {
    return value > 0.0;
  });
}

bool BondLSMLinked::is_viscous() const
{
  return any_above_0(delay);
}

// a minimizer has no velocities
bool BondLSMLinked::has_dashpot(int type) const
{
  return velocity && delay[type] > 0.0 && update->whichflag != 2;
}

std::string BondLSMLinked::retardation() const
{
  std::string text;
  if (!is_viscous()) return text;
  for (int i = 1; i <= atom->nbondtypes; i++)
    text += (i > 1 ? " " : "") + LSM::text::number(delay[i]);
  return text;
}

void BondLSMLinked::allocate()
{
  allocated = 1;
  const int n = atom->nbondtypes + 1;
  memory->create(setflag, n, "bond:setflag");
  std::fill_n(setflag, n, 0);
  for (auto *of_types : {&k, &ratio, &delay}) of_types->assign(n, 0.0);
  factor.assign(n, 1.0);
}

void BondLSMLinked::settings(int narg, char ** /*arg*/)
{
  if (narg != 0)
    error->all(FLERR, "Bond style lsm/linked takes no arguments, but {} were given", narg);
}

void BondLSMLinked::coeff(int narg, char **arg)
{
  int words = 1;
  while (words < narg && utils::is_double(arg[words])) words++;
  double delay_one = 0.0, rest_one = 1.0;
  LSMKeywordReader in(lmp, "Bond lsm/linked", words, narg, arg);
  in.read_all({{"kelvin-voigt", &delay_one, LSM::Must::not_negative},
               {"rest", &rest_one, LSM::Must::positive}});
  if (in.has("rest") && domain->dimension != 3)
    error->all(FLERR, "Bond lsm/linked rest needs a 3-dimensional simulation (dimension 3)");
  if (words != 2 && words != 3)
    error->all(FLERR,
               "Bond style lsm/linked expects 'bond_coeff N k [ratio] [rest FACTOR] [kelvin-voigt "
               "TIME]' with the breaking distance ratio = r_cut/r0 > 1, or no ratio for links that "
               "never break");
  if (!allocated) allocate();
  LSMScene::set_up_next_run(lmp);

  int ilo, ihi;
  utils::bounds(FLERR, arg[0], 1, atom->nbondtypes, ilo, ihi, error);
  const double k_one = utils::numeric(FLERR, arg[1], false, lmp);
  const double ratio_one = words == 3 ? utils::numeric(FLERR, arg[2], false, lmp) : 0.0;
  if (k_one <= 0.0)
    error->all(FLERR, lsm_place(lmp, arg[1]), "Bond lsm/linked stiffness is {}, but must be > 0",
               k_one);
  if (words == 3 && ratio_one <= 1.0)
    error->all(FLERR, lsm_place(lmp, arg[2]),
               "Bond lsm/linked breaking ratio r_cut/r0 is {}, but must be > 1", ratio_one);

  for (int i = ilo; i <= ihi; i++) {
    k[i] = k_one;
    ratio[i] = ratio_one;
    delay[i] = delay_one;
    factor[i] = rest_one;
    setflag[i] = 1;
  }
}

void BondLSMLinked::init_style()
{
  if (!atom->radius_flag)
    error->all(FLERR, Error::NOLASTLINE,
               "Bond style lsm/linked needs particle radii: use atom_style hybrid bond sphere");
  LSMScene::refuse_changing_radii(lmp, "Bond style lsm/linked");
  for (const char *makes_or_breaks : {"^bond/break", "^bond/create", "^bond/react", "^bond/swap"})
    for (const auto &other : modify->get_fix_by_style(makes_or_breaks))
      error->all(
          FLERR, Error::NOLASTLINE,
          "Bond style lsm/linked does not work with fix {} of style {}, as the energy of its "
          "bonds would not be counted; use the breaking ratio of bond_coeff",
          other->id, other->style);
  collected_at = -1;
  for (int i = 1; i <= atom->nbondtypes; i++)    // fix adapt may have changed it
    if (setflag[i] && !(k[i] > 0.0))
      error->all(FLERR, Error::NOLASTLINE, "Bond lsm/linked: k of type {} is {}, but must be > 0",
                 i, k[i]);

  LSMScene::set_up_next_run(lmp);
  velocity = is_viscous() ? FixLSMVelocity::of(lmp) : nullptr;
  find_largest_radius();

  // only links that can break need the fix that tells the other ranks and updates the topology
  if (any_above_0(ratio) && !modify->get_fix_by_id("LSM_BREAK"))
    modify->add_fix("LSM_BREAK all LSM_BREAK");
}

// bond_write asks for it before it initializes the style
double BondLSMLinked::equilibrium_distance(int type)
{
  if (LSMScene::is_command(lmp, "bond_write")) find_largest_radius();
  return 2.0 * maxrad * factor[type];
}

void BondLSMLinked::find_largest_radius()
{
  double mine = 0.0;
  for (int i = 0; atom->radius && i < atom->nlocal; i++) mine = MAX(mine, atom->radius[i]);
  maxrad = lsm_largest(mine, world);
}

void BondLSMLinked::coefficients_in(LSMRestartFile file)
{
  file.version();
  for (auto *of_types : {&k, &ratio, &delay}) file.fixed(*of_types);
  if (domain->dimension == 3) file.fixed(factor);
}

void BondLSMLinked::write_restart(FILE *fp)
{
  coefficients_in({lmp, fp, false});
}

void BondLSMLinked::read_restart(FILE *fp)
{
  allocate();
  coefficients_in({lmp, fp, true});
  for (int i = 1; i <= atom->nbondtypes; i++) setflag[i] = 1;
}

void BondLSMLinked::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->nbondtypes; i++) {
    fprintf(fp, "%d %.17g", i, k[i]);
    if (ratio[i] > 0.0) fprintf(fp, " %.17g", ratio[i]);
    if (factor[i] != 1.0) fprintf(fp, " rest %.17g", factor[i]);
    if (delay[i] > 0.0) fprintf(fp, " kelvin-voigt %.17g", delay[i]);
    fputs("\n", fp);
  }
}

double BondLSMLinked::single(int type, double rsq, int i, int j, double &fforce)
{
  const double r = sqrt(rsq);
  const double stretch = r - factor[type] * (atom->radius[i] + atom->radius[j]);
  double pull = LSM::Spring::force(k[type], stretch);
  if (has_dashpot(type) && r > 0.0)
    pull += LSM::Dashpot::force(k[type] * delay[type],
                                velocity->rate(i, domain->closest_image(i, j), r));
  fforce = r > 0.0 ? -pull / r : 0.0;
  return LSM::Spring::energy(k[type], stretch);
}

void *BondLSMLinked::extract(const char *str, int &dim)
{
  dim = 1;
  return strcmp(str, "k") == 0 ? k.data() : nullptr;
}
