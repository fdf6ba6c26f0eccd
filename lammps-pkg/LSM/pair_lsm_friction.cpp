// SPDX-License-Identifier: GPL-2.0-or-later

#include "pair_lsm_friction.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_dummy.h"
#include "fix_lsm_history.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include "friction/friction_contact.h"
#include "friction/friction_laws.h"
#include "lsm_contact_recorder.h"
#include "lsm_keyword_reader.h"
#include "lsm_link_kernel.h"
#include "lsm_restart_file.h"
#include "lsm_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
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
      pair(style), x(style.atom->x[0]), f(style.atom->f[0]), nlocal(style.atom->nlocal),
      reach_sq(style.near_reach() * style.near_reach()), step{style.update->setupflag != 0,
                                                              rounding(style.domain),
                                                              style.update->dt * style.time_ratio,
                                                              style.locate_onset != 0},
      side_by_side(Law::state_size == 0 && !Recorder::tallies && !step.setup && !style.screened &&
                   !style.velocity),
      recorder(style, step.setup)
  {
  }

  [[gnu::always_inline]] void run()
  {
    const int count = pair.near.size();
    for (int first = 0; first < count; first += LANES) {
      if (side_by_side) continue_all(first, count);
      for (int n = first; n < MIN(first + LANES, count); n++) {
        const int place = pair.near[n], lane = n - first;
        const bool before = pair.near.is_touching(place);
        double *const h = &pair.histories[static_cast<size_t>(place) * size];
        if (side_by_side && before && block.rsq[lane] < block.r0[lane] * block.r0[lane]) {
          const Site &site = pair.sites[place];
          const bool both = pair.newton_pair || site.j < nlocal;
          const Push push = block.push(lane);
          if constexpr (Recorder::records) record(site, false, push, both);
          keep<Law>(push.step, block.delx[lane], block.dely[lane], h);
          add_forces(site, push, both);
          continue;
        }
        if (!side_by_side && n + AHEAD < count) fetch_forces(pair.sites[pair.near[n + AHEAD]]);
        bool touch = before;
        if (!before && place < pair.kept_before) {
          const double *const d = pair.near.vector_before(place), r0 = pair.sites[place].r0;
          keep_near(d[0] * d[0] + d[1] * d[1] <= reach_sq * r0 * r0, d[0], d[1], touch, h);
        } else if (!before)
          touch = *pair.fix_history->touch_of(pair.near.kept()[place]);
        evaluate(place, touch, h);
        const bool after = touch && h[STATUS] != NEAR;
        if (after != before) pair.near.set_touching(place, after);
      }
    }
    recorder.finish();
  }

 private:
  static constexpr int LANES = 32, AHEAD = 8, size = LAW_STATE + Law::state_size;
  PairLSMFriction &pair;
  const double *const x;
  double *const f;
  const int nlocal;
  const double reach_sq;
  const Step step;
  const bool side_by_side;
  Recorder recorder;

  struct Geometry {
    double rsq, r, nx, ny;

    Geometry(double delx, double dely) : rsq(delx * delx + dely * dely), r(sqrt(rsq))
    {
      const double rinv = r > 0.0 ? 1.0 / r : 0.0;
      nx = delx * rinv;
      ny = dely * rinv;
    }
  };

  struct Push {
    double fx, fy;                // on the first particle
    double normal, tangential;    // energies of the springs
    LSM::FrictionStep step;
  };
  [[gnu::always_inline]] static Push push_of(const Geometry &g, double stretch, double k, double kt,
                                             double fn, const LSM::FrictionStep &s)
  {
    return {fn * g.nx + s.force * g.ny, fn * g.ny - s.force * g.nx, LSM::Spring::energy(k, stretch),
            LSM::Spring::energy(kt, s.xi), s};
  }

  // Most contacts were there in the step before: those that follow each other are computed side by
  // side, in a loop that compilers turn into vectors, and take their turn afterwards. It gives the
  // same digits with each instruction set.
  struct alignas(64) Block {
    double delx[LANES], dely[LANES], h[LAW_STATE][LANES];
    double r0[LANES], k[LANES], coefficients[std::size(Law::parameters)][LANES];
    double rsq[LANES], fx[LANES], fy[LANES], normal[LANES], tangential[LANES];
    double slip[LANES], dissipated[LANES];

    Push push(int n) const
    {
      const bool slides = Law::needs_sliding && h[STATUS][n] == SLIDES;
      const LSM::FrictionStep s = {h[XI][n], 0.0, slip[n], dissipated[n], slides};
      return {fx[n], fy[n], normal[n], tangential[n], s};
    }
    [[gnu::always_inline]] void solve(double time)
    {
      for (int n = 0; n < LANES; n++) {
        const Geometry g(delx[n], dely[n]);
        const auto c =
            LSMLawTable::coefficients<Law>([this, n](std::size_t p) { return coefficients[p][n]; });
        const LSM::FrictionContact contact{LSM::contact_normal_force(k[n], g.r, r0[n]), h[XI][n],
                                           displacement(delx[n], dely[n], h[DX][n], h[DY][n]), time,
                                           Law::needs_sliding && h[STATUS][n] == SLIDES};
        const Push done =
            push_of(g, g.r - r0[n], k[n], c.kt, contact.fn, LSM::friction_step<Law>(c, contact));
        rsq[n] = g.rsq;
        fx[n] = done.fx;
        fy[n] = done.fy;
        h[XI][n] = done.step.xi;
        if constexpr (Law::needs_sliding) h[STATUS][n] = done.step.sliding ? SLIDES : STICKS;
        if constexpr (!Recorder::records) continue;
        normal[n] = done.normal;
        tangential[n] = done.tangential;
        slip[n] = done.step.slip;
        dissipated[n] = done.step.dissipated;
      }
    }
    LSM_AVX2 void solve_avx2(double time) { solve(time); }
  };
  Block block;

  // Prefetches the forces of a contact's particles, which are far from each other in memory.
  void fetch_forces(const Site &site) const
  {
    for (const int i : {site.i, site.j}) __builtin_prefetch(f + 3 * static_cast<size_t>(i), 1);
  }

  [[gnu::always_inline]] void continue_all(int first, int count)
  {
    for (int lane = 0; lane < LANES; lane++) {
      const int place = pair.near[MIN(first + lane, count - 1)];
      const Site &site = pair.sites[place];
      fetch_forces(site);
      const double *const d = pair.near.vector(place);
      const double *const h = &pair.histories[static_cast<size_t>(place) * size];
      block.delx[lane] = d[0];
      block.dely[lane] = d[1];
      for (int c = 0; c < LAW_STATE; c++) block.h[c][lane] = h[c];
      block.r0[lane] = site.r0;
      block.k[lane] = pair.k.at(site.types);
      for (std::size_t p = 0; p < std::size(Law::parameters); p++)
        block.coefficients[p][lane] = pair.table[p].at(site.types);
    }
    if (LSMLinkKernel::has_avx2())
      block.solve_avx2(step.time);
    else
      block.solve(step.time);
  }

  static double rounding(const Domain *domain)
  {
    double farthest = 0.0;
    for (int c = 0; c < 2; c++)
      farthest = MAX(farthest, MAX(fabs(domain->boxlo[c]), fabs(domain->boxhi[c])));
    return 16.0 * std::numeric_limits<double>::epsilon() * farthest;
  }

  [[gnu::always_inline]] double normal_force(const Site &site, double r, bool apart,
                                             bool both) const
  {
    double fn = LSM::contact_normal_force(pair.k.at(site.types), r, site.r0);
    if (pair.velocity && !apart && r > 0.0) {
      double rate;
      const double more = pair.dashpot(site.i, site.j, r, fn, rate);
      fn += more;
      pair.velocity->power -= (both ? 1.0 : 0.5) * more * rate;
    }
    return fn;
  }

  [[gnu::always_inline]] void evaluate(int place, bool &touch, double *h)
  {
    const Site &site = pair.sites[place];
    const double r0 = site.r0, delx = pair.near.vector(place)[0], dely = pair.near.vector(place)[1];
    const Geometry g(delx, dely);
    const bool apart = g.rsq >= r0 * r0;
    if (apart && !touch && g.rsq > reach_sq * r0 * r0) return;
    if (pair.screened && pair.left_out(pair.entry_of(place), site.i, site.j)) {
      touch = false;
      return;
    }
    if (apart && (!touch || h[STATUS] == NEAR)) {
      keep_near(g.rsq <= reach_sq * r0 * r0, delx, dely, touch, h);
      return;
    }
    const auto c = LSMLawTable::coefficients<Law>(
        [this, &site](std::size_t p) { return pair.table[p].at(site.types); });

    LSM::FrictionContact contact{0.0, 0.0, 0.0, 0.0, false};
    const bool moved = follow<Law>(step, c, delx, dely, g.r, r0, touch, h, contact);
    const bool both = pair.newton_pair || site.j < nlocal;
    contact.fn = normal_force(site, g.r, apart, both);
    const Push push = push_of(g, apart ? 0.0 : g.r - r0, pair.k.at(site.types), c.kt, contact.fn,
                              next<Law>(moved || apart, c, contact, h));
    if constexpr (Recorder::records) record(site, apart, push, both);
    if (apart) {
      keep_near(g.rsq <= reach_sq * r0 * r0, delx, dely, touch, h);
      return;
    }
    keep<Law>(push.step, delx, dely, h);
    add_forces(site, push, both);
    if constexpr (Recorder::tallies)
      pair.ev_tally_xyz(site.i, site.j, nlocal, pair.newton_pair, push.normal + push.tangential,
                        0.0, push.fx, push.fy, 0.0, delx, dely, 0.0);
  }

  [[gnu::always_inline]] void add_forces(const Site &site, const Push &push, bool both)
  {
    double *const fi = f + 3 * static_cast<size_t>(site.i);
    double *const fj = f + 3 * static_cast<size_t>(site.j);
    fi[0] += push.fx;
    fi[1] += push.fy;
    if (both) {
      fj[0] -= push.fx;
      fj[1] -= push.fy;
    }
  }

  [[gnu::always_inline]] void record(const Site &site, bool apart, const Push &push, bool both)
  {
    const double share = both ? 1.0 : 0.5;
    const LSM::FrictionStep &s = push.step;
    recorder.springs(share, push.normal, push.tangential);
    recorder.dissipation(share, s.dissipated);
    recorder.slip(share, fabs(s.slip) * site.size);
    if (!recorder.wants_contacts()) return;
    if (site.across == 0) {
      recorder.within(share, s.dissipated);
      return;
    }
    const double place =
        0.5 * (x[3 * static_cast<size_t>(site.i)] + x[3 * static_cast<size_t>(site.j)]);
    recorder.contact({place, s.dissipated, -site.across * (apart ? 0.0 : push.fx), share});
  }
};

template <class Law, class Recorder> void PairLSMFriction::run_loop()
{
  Loop<Law, Recorder>(*this).run();
  noted = false;
  if (screened) note_contacts();    // only here it is known which pairs are left out
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
  kept_before = find_near(MAX(near_reach(), 1.0), fix_history->firstflag);
  collect_sites(kept_before);
  constexpr int groups = 8 * sizeof(int);
  if (std::count(group->dynamic, group->dynamic + groups, 1))
    for (Site &site : sites) site.across = across_fault(atom->mask[site.i], atom->mask[site.j]);
  (this->*loops[running - &LSMLawTable::all()[0]][evflag ? 2 : record_what ? 1 : 0])();
}

int PairLSMFriction::entry_of(int place) const
{
  const LSMNearPairs::Pair &pair = near.kept()[place];
  return list->firstneigh[pair.i][pair.jj];
}

void PairLSMFriction::collect_sites(int first)
{
  const double *const radius = contact_radii();
  const int size = size_history(), count = static_cast<int>(near.kept().size());
  sites.resize(first);
  histories.resize(static_cast<size_t>(first) * size);
  sites_build = neighbor->ncalls;
  for (int place = first; place < count; place++) {
    const LSMNearPairs::Pair &pair = near.kept()[place];
    const int i = pair.i, j = entry_of(place) & NEIGHMASK;
    const double *const h = fix_history->values_of(pair);
    if (*fix_history->touch_of(pair) && h[STATUS] == NEAR) near.set_touching(place, false);
    sites.push_back({i, j, k.place(atom->type[i], atom->type[j]),
                     across_fault(atom->mask[i], atom->mask[j]), radius[i] + radius[j],
                     LSM::contact_size(radius[i], radius[j])});
    histories.insert(histories.end(), h, h + size);
  }
}

void PairLSMFriction::note_added(int i, int jj)
{
  fix_history->add_pair(i, jj);
}

// Pairs that do not touch have no state: whether one is near follows from its vector alone.
void PairLSMFriction::note_contacts()
{
  if (noted || sites_build != neighbor->ncalls) return;
  noted = true;
  const int size = size_history();
  const double reach_sq = near_reach() * near_reach();
  for (size_t n = 0; n < sites.size(); n++) {
    const int place = static_cast<int>(n);
    const Site &site = sites[n];
    double *const h = &histories[n * size];
    bool touch = near.is_touching(place);
    if (!touch) {
      const double *const d = near.vector(place);
      const bool is_near = d[0] * d[0] + d[1] * d[1] <= reach_sq * site.r0 * site.r0 &&
                           !(screened && left_out(entry_of(place), site.i, site.j));
      keep_near(is_near, d[0], d[1], touch, h);
    }
    std::copy_n(h, size, fix_history->values_of(near.kept()[n]));
    *fix_history->touch_of(near.kept()[n]) = touch;
  }
}

void PairLSMFriction::load_contacts(const double *shear)
{
  note_contacts();
  near.clear();    // it has stored which pairs touch
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
  parse_law(1, only_kt);    // reports errors in the coefficients of pair_style right away
}

// parses kt and the coefficients of the law, which may be those of pair_style
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
  noted = true;           // the history was updated at the end of the previous run
  running = table.law;    // see init_one()
  PairLSMFree::init_style();

  if (update->whichflag) check_periods();

  // the same name whichever styles were defined before, so that a restart finds the history
  const std::string id_history = "NEIGH_HISTORY_LSM";
  if (!fix_history) {
    fix_history = dynamic_cast<FixLSMHistory *>(
        modify->replace_fix("NEIGH_HISTORY_LSM_DUMMY",
                            fmt::format("{} all LSM_HISTORY {} {}", id_history, size_history(),
                                        table.law->state_size ? table.law->name : ""),
                            1));
    fix_history->pair = this;
  } else {
    fix_history = dynamic_cast<FixLSMHistory *>(modify->get_fix_by_id(id_history));
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

  // takes the next law of this name that fits; within a run it does not go back
  while (!running->fits(values.data())) {
    if (running == &LSMLawTable::all().back() || strcmp((++running)->name, table.law->name) != 0)
      error->all(FLERR, "Pair lsm/friction: the law {} cannot be run with the coefficients{}",
                 table.law->name, types);
  }
  return cut;
}

// the history of a pair as seen from the other particle
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
