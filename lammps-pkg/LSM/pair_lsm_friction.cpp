// SPDX-License-Identifier: GPL-2.0-or-later

#include "pair_lsm_friction.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_dummy.h"
#include "fix_lsm_velocity.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include "friction/friction_contact.h"
#include "friction/friction_laws.h"
#include "lsm_contact_recorder.h"
#include "lsm_keyword_reader.h"
#include "lsm_restart_file.h"
#include "lsm_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace LSM::friction_contact;

double PairLSMFriction::near_reach() const
{
  return locate_onset ? NEAR_REACH : 0.0;
}

int PairLSMFriction::size_history() const
{
  return LAW_STATE + table.law->state_size;
}

PairLSMFriction::PairLSMFriction(LAMMPS *_lmp) : PairLSMFree(_lmp), table(_lmp), running(table.law)
{
  centroidstressflag = CENTROID_NOTAVAIL;
  nondefault_history_transfer = 1;
  request_flags |= NeighConst::REQ_HISTORY;

  // a contact lost in the step in which the list is built keeps its history until its release is
  // counted
  beyond_contact = 1;
  single_extra = 2;
  svector = of_single;

  // a second one would take the contact history of the first
  if (modify->get_fix_by_id("NEIGH_HISTORY_LSM_DUMMY") ||
      modify->get_fix_by_id("NEIGH_HISTORY_LSM"))
    error->all(
        FLERR,
        "Pair style lsm/friction can be used once only, also under pair_style hybrid; give several "
        "pair_coeff commands to one");

  // placeholder so that the order of fixes is that of the input script
  fix_dummy = dynamic_cast<FixDummy *>(modify->add_fix("NEIGH_HISTORY_LSM_DUMMY all DUMMY"));
}

PairLSMFriction::~PairLSMFriction()
{
  modify->delete_fix(fix_history ? "NEIGH_HISTORY_LSM" : "NEIGH_HISTORY_LSM_DUMMY");
}

// The loop over the pairs within reach, compiled for each law and recorder. The setup of a run
// evaluates the forces of a step that was done: the state of the contacts stays, so that a run in
// pieces equals one run, and a contact that slides goes on sliding. Only where a command moved
// particles since, by more than they are rounded when they cross a border of the box, their
// contacts follow.
template <class Law, class Recorder> class PairLSMFriction::Loop {
 public:
  explicit Loop(PairLSMFriction &style) :
      pair(style), x(style.atom->x), f(style.atom->f[0]), radius(style.contact_radii()),
      nlocal(style.atom->nlocal), size(style.size_history()),
      reach_sq(style.near_reach() * style.near_reach()), step{style.update->setupflag != 0,
                                                              rounding(style.domain),
                                                              style.update->dt * style.time_ratio,
                                                              style.locate_onset != 0},
      mask(style.atom->mask),
      recorder(style, step.setup, style.domain->boxlo[0], style.domain->prd[0])
  {
  }

  // The particles of contacts are far from each other in memory: their forces are fetched some
  // contacts ahead.
  [[gnu::always_inline]] void run()
  {
    constexpr int AHEAD = 8;
    const int count = pair.near.size();
    for (int n = 0; n < count; n++) {
      if (n + AHEAD < count) {
        const Site &site = pair.sites[pair.near[n + AHEAD]];
        for (const int i : {site.i, site.j}) __builtin_prefetch(f + 3 * static_cast<size_t>(i), 1);
      }
      const int place = pair.near[n];
      const bool before = pair.near.is_touching(place);
      bool touch = before;
      double *const h = &pair.histories[static_cast<size_t>(place) * size];
      if (!before && !pair.chosen_anew) {
        const double *const d = pair.near.vector_before(place), r0 = pair.sites[place].r0;
        keep_near(d[0] * d[0] + d[1] * d[1] <= reach_sq * r0 * r0, d[0], d[1], touch, h);
      } else if (!before)
        touch = *pair.origins[place].touch;
      evaluate(place, touch, h);
      const bool after = touch && h[STATUS] != NEAR;
      if (after != before) pair.near.set_touching(place, after);
    }
    recorder.finish();
  }

 private:
  PairLSMFriction &pair;
  double **const x, *const f;
  const double *const radius;
  const int nlocal, size;
  const double reach_sq;
  const Step step;
  const int *const mask;
  Recorder recorder;

  struct Geometry {
    double delx, dely, rsq, r, nx, ny;
    bool apart;
  };
  static double rounding(const Domain *domain)
  {
    double farthest = 0.0;
    for (int c = 0; c < 2; c++)
      farthest = MAX(farthest, MAX(fabs(domain->boxlo[c]), fabs(domain->boxhi[c])));
    return 16.0 * std::numeric_limits<double>::epsilon() * farthest;
  }

  [[gnu::always_inline]] double normal_force(const Site &site, const Geometry &g, bool both) const
  {
    double fn = LSM::contact_normal_force(pair.k[site.itype][site.jtype], g.r, site.r0);
    if (pair.velocity && !g.apart && g.r > 0.0) {
      double rate;
      const double more = pair.dashpot(site.i, site.j, g.r, fn, rate);
      fn += more;
      pair.velocity->power -= (both ? 1.0 : 0.5) * more * rate;
    }
    return fn;
  }

  [[gnu::always_inline]] void evaluate(int place, bool &touch, double *h)
  {
    const Site &site = pair.sites[place];
    const int itype = site.itype, jtype = site.jtype;
    const double r0 = site.r0;
    Geometry g;
    g.delx = pair.near.vector(place)[0];
    g.dely = pair.near.vector(place)[1];
    g.rsq = g.delx * g.delx + g.dely * g.dely;
    g.apart = g.rsq >= r0 * r0;
    if (g.apart && !touch && g.rsq > reach_sq * r0 * r0) return;
    if (pair.screened && pair.left_out(pair.origins[place].entry, itype, jtype)) {
      touch = false;
      return;
    }
    if (g.apart && (!touch || h[STATUS] == NEAR)) {
      keep_near(g.rsq <= reach_sq * r0 * r0, g.delx, g.dely, touch, h);
      return;
    }
    g.r = sqrt(g.rsq);
    const double rinv = g.r > 0.0 ? 1.0 / g.r : 0.0;
    g.nx = g.delx * rinv;
    g.ny = g.dely * rinv;
    const auto c = LSMLawTable::coefficients<Law>(
        [this, itype, jtype](std::size_t p) { return pair.table[p][itype][jtype]; });

    LSM::FrictionContact contact{0.0, 0.0, 0.0, 0.0, false};
    const bool moved = follow<Law>(step, c, g.delx, g.dely, g.r, r0, touch, h, contact);
    const bool both = pair.newton_pair || site.j < nlocal;
    contact.fn = normal_force(site, g, both);
    const LSM::FrictionStep s = next<Law>(moved || g.apart, c, contact, h);
    if constexpr (Recorder::records) record(site, g, c.kt, contact.fn, s, both);
    if (g.apart) {
      keep_near(g.rsq <= reach_sq * r0 * r0, g.delx, g.dely, touch, h);
      return;
    }
    keep<Law>(s, g.delx, g.dely, h);
    add_forces(site, g, c.kt, contact.fn, s, both);
  }

  [[gnu::always_inline]] void add_forces(const Site &site, const Geometry &g, double kt, double fn,
                                         const LSM::FrictionStep &s, bool both)
  {
    const int i = site.i, j = site.j;
    const double fx = fn * g.nx + s.force * g.ny, fy = fn * g.ny - s.force * g.nx;
    double *const fi = f + 3 * static_cast<size_t>(i), *const fj = f + 3 * static_cast<size_t>(j);
    fi[0] += fx;
    fi[1] += fy;
    if (both) {
      fj[0] -= fx;
      fj[1] -= fy;
    }
    if constexpr (Recorder::tallies)
      pair.ev_tally_xyz(i, j, nlocal, pair.newton_pair,
                        LSM::Spring::energy(pair.k[site.itype][site.jtype], g.r - site.r0) +
                            LSM::Spring::energy(kt, s.xi),
                        0.0, fx, fy, 0.0, g.delx, g.dely, 0.0);
  }

  [[gnu::always_inline]] void record(const Site &site, const Geometry &g, double kt, double fn,
                                     const LSM::FrictionStep &s, bool both)
  {
    const int i = site.i, j = site.j;
    const double share = both ? 1.0 : 0.5;
    const double kij = pair.k[site.itype][site.jtype];
    recorder.springs(share, g.apart ? 0.0 : LSM::Spring::energy(kij, g.r - site.r0),
                     LSM::Spring::energy(kt, s.xi));
    recorder.dissipation(share, s.dissipated);
    const double moment = s.slip != 0.0 ? fabs(s.slip) * LSM::contact_size(radius[i], radius[j])
                                        : 0.0;
    recorder.slip(share, moment);
    if (!recorder.wants_places()) return;
    const int upper = pair.across_fault(mask[i], mask[j]);
    if (upper == 0) {
      recorder.within(share, s.dissipated);
      return;
    }
    const double place = 0.5 * (x[i][0] + x[j][0]);
    if (moment != 0.0) recorder.slip_at(share, place, moment);
    if (!recorder.wants_contacts()) return;
    const double along = g.apart ? 0.0 : fn * g.nx + s.force * g.ny;
    recorder.contact({place, s.dissipated, -upper * along, share});
  }
};

template <class Law, class Recorder> void PairLSMFriction::run_loop()
{
  Loop<Law, Recorder>(*this).run();
  noted = false;
  if (screened) note_contacts();    // what is left out is known only here
}

void PairLSMFriction::compute(int eflag, int vflag)
{
  static constexpr void (PairLSMFriction::*loops[][3])() = {
#define LSM_FRICTION_LAW(law)                               \
  {&PairLSMFriction::run_loop<LSM::law, LSMRecordNothing>,  \
   &PairLSMFriction::run_loop<LSM::law, LSMRecordEnergies>, \
   &PairLSMFriction::run_loop<LSM::law, LSMRecordAndTally>},
#include "friction/friction_laws.h"
#undef LSM_FRICTION_LAW
  };
  ev_init(eflag, vflag);
  if (screened) check_special();
  chosen_anew = find_near(MAX(near_reach(), 1.0), fix_history->firstflag);
  if (chosen_anew) collect_sites();
  (this->*loops[running - &LSMLawTable::all()[0]][evflag ? 2 : record_what ? 1 : 0])();
}

void PairLSMFriction::collect_sites()
{
  const double *const radius = contact_radii();
  const int size = size_history();
  sites.clear();
  origins.clear();
  histories.clear();
  sites_build = neighbor->ncalls;
  for (const LSMNearPairs::Pair &pair : near.kept()) {
    const int i = pair.i, entry = list->firstneigh[i][pair.jj], j = entry & NEIGHMASK;
    double *const h = fix_history->firstvalue[i] + size * pair.jj;
    int *const touch = fix_history->firstflag[i] + pair.jj;
    if (*touch && h[STATUS] == NEAR) near.set_touching(static_cast<int>(sites.size()), false);
    sites.push_back({i, j, atom->type[i], atom->type[j], radius[i] + radius[j]});
    origins.push_back({h, touch, entry});
    histories.insert(histories.end(), h, h + size);
  }
}

// Pairs that do not touch have no memory: whether one is near follows from its vector.
void PairLSMFriction::note_contacts()
{
  if (noted || sites_build != neighbor->ncalls) return;
  noted = true;
  const int size = size_history();
  const double reach_sq = near_reach() * near_reach();
  for (size_t n = 0; n < sites.size(); n++) {
    const int place = static_cast<int>(n);
    const Site &site = sites[n];
    const Origin &origin = origins[n];
    double *const h = &histories[n * size];
    bool touch = near.is_touching(place);
    if (!touch) {
      const double *const d = near.vector(place);
      const bool is_near = d[0] * d[0] + d[1] * d[1] <= reach_sq * site.r0 * site.r0 &&
                           !(screened && left_out(origin.entry, site.itype, site.jtype));
      keep_near(is_near, d[0], d[1], touch, h);
    }
    std::copy_n(h, size, origin.history);
    *origin.touch = touch;
  }
}

void PairLSMFriction::load_contacts(const double *shear)
{
  note_contacts();
  near.clear();    // it knows which pairs touch
  double **x = atom->x;
  const double *radius = contact_radii();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      const double delx = x[i][0] - x[j][0], dely = x[i][1] - x[j][1];
      const double r0 = radius[i] + radius[j];
      const int itype = atom->type[i], jtype = atom->type[j];
      if (!active[itype][jtype] || delx * delx + dely * dely >= r0 * r0) continue;
      const std::vector<double> values = table.values(itype, jtype);
      double *const h = &fix_history->firstvalue[i][size_history() * jj];
      fix_history->firstflag[i][jj] = 1;
      h[XI] = -shear[i] / values[0];
      h[DX] = delx;
      h[DY] = dely;
      h[STATUS] = STICKS;
      table.law->begin(values.data(), h + LAW_STATE);
    }
  }
}

void PairLSMFriction::allocate()
{
  PairLSMFree::allocate();
  table.create();
}

// another law has other coefficients, and cannot continue with the contacts of the previous one
void PairLSMFriction::choose(const LSMLaw *wanted)
{
  if (wanted == table.law) return;
  if (fix_history || restored)
    error->all(FLERR,
               "Pair style lsm/friction has contacts of the law {}{}, and cannot go on with the "
               "law {}; give 'pair_style none' and 'run 0' first to forget them",
               table.law->name, restored ? " from a restart file" : "", wanted->name);
  table.law = running = wanted;
  if (!allocated) return;
  table.create();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) setflag[i][j] = on[i][j] = 0;
}

void PairLSMFriction::settings(int narg, char **arg)
{
  const LSMLaw *wanted = &LSMLawTable::all()[0];
  int words = 0;
  while (words < narg && strcmp(arg[words], "onset") != 0) words++;
  if (words > 0) wanted = LSMLawTable::find(arg[0]);
  if (!wanted)
    error->all(FLERR,
               "Pair style lsm/friction expects [LAW [COEFFICIENTS]] [onset located|step] with one "
               "of the laws {}, got '{}'",
               LSMLawTable::names(), arg[0]);
  int at_end = 0;
  const LSM::Keywords keywords = {{"onset", LSM::Words{&at_end, {"located", "step"}}}};
  LSMKeywordReader(lmp, "Pair style lsm/friction", words, narg, arg).read_all(keywords);
  locate_onset = !at_end;
  choose(wanted);
  common.assign(arg + MIN(words, 1), arg + words);
  if (common.empty()) return;
  const bool number = utils::is_double(common[0]);
  if (number == table.law->named)
    error->all(FLERR, "Pair style lsm/friction {} expects {} or onset located|step, got '{}'",
               table.law->name, table.law->named ? "pairs NAME VALUE" : "numbers", common[0]);
  char kt[] = "1.0", *only_kt[] = {kt};
  parse_law(1, only_kt);    // a mistake is named here
}

// kt and the law's coefficients, which may be those of pair_style
void PairLSMFriction::parse_law(int narg, char **arg)
{
  std::vector<char *> words(arg, arg + MAX(narg, 0));
  if (narg == 1)
    for (std::string &word : common) words.push_back(word.data());
  table.parse(static_cast<int>(words.size()), words.data());
}

void PairLSMFriction::init_style()
{
  if (domain->dimension != 2)
    error->all(FLERR, "Pair style lsm/friction needs a 2-dimensional simulation (dimension 2)");

  // forces at displaced positions would slide contacts
  if (!modify->get_fix_by_style("^numdiff").empty())
    error->all(
        FLERR,
        "Pair style lsm/friction does not work with fix numdiff, as friction depends on the path");

  time_ratio = 1.0;
  noted = true;           // at the end of the run before
  running = table.law;    // see init_one()
  PairLSMFree::init_style();

  if (update->whichflag) check_periods();

  // one name, whichever styles came before, so that a restart finds the history
  const std::string id_history = "NEIGH_HISTORY_LSM";
  if (!fix_history) {
    fix_history = dynamic_cast<FixNeighHistory *>(
        modify->replace_fix("NEIGH_HISTORY_LSM_DUMMY",
                            fmt::format("{} all LSM_HISTORY {} {}", id_history, size_history(),
                                        table.law->state_size ? table.law->name : ""),
                            1));
    fix_history->pair = this;
  } else {
    fix_history = dynamic_cast<FixNeighHistory *>(modify->get_fix_by_id(id_history));
    if (!fix_history) error->all(FLERR, "Could not find the contact history of pair lsm/friction");
  }
}

// the history of a pair is found by the IDs of its particles
void PairLSMFriction::check_periods() const
{
  double reach = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (on[i][j]) reach = MAX(reach, maxrad[i] + maxrad[j] + neighbor->skin);
  for (int c = 0; c < 2; c++)
    if (domain->periodicity[c] && domain->prd[c] < 2.0 * reach)
      error->all(FLERR,
                 "Pair style lsm/friction: the period of the box in {} is {:.6g}, but must be at "
                 "least {:.6g} (twice the largest contact distance with the neighbor skin), as a "
                 "pair would meet itself on both sides",
                 c ? "y" : "x", domain->prd[c], 2.0 * reach);
}

double PairLSMFriction::init_one(int i, int j)
{
  const double cut = PairLSMFree::init_one(i, j);

  table.mirror(i, j);
  if (!on[i][j]) return cut;
  const std::string types = fmt::format(" of types {} {}", i, j);
  const std::vector<double> values = table.values(i, j);
  table.check(values, types);

  // the list has another law of the name; within a run there is no way back
  while (!running->fits(values.data())) {
    if (running == &LSMLawTable::all().back() || strcmp((++running)->name, table.law->name) != 0)
      error->all(FLERR, "Pair lsm/friction: the law {} cannot be run with the coefficients{}",
                 table.law->name, types);
  }
  return cut;
}

// history of the pair as seen from the other particle
void PairLSMFriction::transfer_history(double *source, double *target, int, int)
{
  target[XI] = source[XI];
  target[DX] = -source[DX];
  target[DY] = -source[DY];
  for (int n = STATUS; n < size_history(); n++) target[n] = source[n];
}

void PairLSMFriction::write_restart_settings(FILE *fp)
{
  PairLSMFree::write_restart_settings(fp);
  std::string name = table.law->name;
  LSMRestartFile(lmp, fp, false)(name);
}

void PairLSMFriction::read_restart_settings(FILE *fp)
{
  PairLSMFree::read_restart_settings(fp);
  restored = true;
  std::string name;
  LSMRestartFile(lmp, fp, true)(name);
  table.law = running = LSMLawTable::find(name);
  if (!running)
    error->all(
        FLERR,
        "Pair style lsm/friction: the restart file has contacts of the law {}, expected one of {}",
        name, LSMLawTable::names());
}

// normal force and energy of both springs; svector = elongation of the tangential spring and the
// tangential force on i along (-ny,nx)
double PairLSMFriction::single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                               double factor_lj, double &fforce)
{
  note_contacts();
  double energy = PairLSMFree::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  svector[0] = svector[1] = 0.0;
  if (fforce == 0.0) return energy;

  const double kt = table[0][MIN(itype, jtype)][MAX(itype, jtype)];
  const int *jlist = list->firstneigh[i];
  for (int jj = 0; jj < list->numneigh[i]; jj++)
    if ((jlist[jj] & NEIGHMASK) == j) {
      svector[0] = fix_history->firstvalue[i][size_history() * jj + XI];
      svector[1] = -kt * svector[0];
      energy += LSM::Spring::energy(kt, svector[0]);
      break;
    }
  return energy;
}

void *PairLSMFriction::extract(const char *str, int &dim)
{
  dim = 2;
  double **const found = table.find_coefficient(str);
  return found ? (void *) found : PairLSMFree::extract(str, dim);
}
