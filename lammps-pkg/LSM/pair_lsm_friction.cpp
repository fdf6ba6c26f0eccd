/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

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

#include "laws/friction_laws.h"
#include "lsm_contact_recorder.h"
#include "lsm_force_laws.h"
#include "lsm_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#define LSM_LAMBDA __attribute__((always_inline))

using namespace LAMMPS_NS;

// values stored per pair: elongation of the tangential spring along the tangent (-ny,nx), the vector from j
// to i in the step before, the status, and the state of the law, if it has one. The first four are always there, so
// that a restart may switch static friction or the onset on or off. All but the vector, which changes its sign, are
// the same seen from i and from j.
// With onset located, pairs that nearly touch are stored as well, so that the vector before the contact
// is known.

enum { XI, DX, DY, STATUS, LAW_STATE };
static constexpr double STICKS = 0.0, SLIDES = 1.0, NEAR = -1.0;
static constexpr double NEAR_REACH = 1.05;    // in sums of radii

// ---- the laws ----

template <class Law, class Value, std::size_t... n>
static typename Law::Coefficients coefficients_of(const Value &value, std::index_sequence<n...>)
{
  return {value(n)...};
}

template <class Law>
static constexpr auto parameters_of = std::make_index_sequence<std::size(Law::parameters)>();

template <class Law> static bool fits(const double *values)
{
  return Law::fits(
      coefficients_of<Law>([values](std::size_t n) { return values[n]; }, parameters_of<Law>));
}

template <class Law> static void begin(const double *values, double *state)
{
  Law::begin(
      coefficients_of<Law>([values](std::size_t n) { return values[n]; }, parameters_of<Law>),
      state);
}

template <class Chosen> PairLSMFriction::Law PairLSMFriction::entry()
{
  constexpr int count = static_cast<int>(std::size(Chosen::parameters));
  static_assert(count <= MAX_PARAMETERS &&
                    sizeof(typename Chosen::Coefficients) == count * sizeof(double),
                "as many parameters as coefficients, and room for them");
  return {Chosen::name,
          Chosen::parameters,
          count,
          Chosen::state_size,
          Chosen::named,
          &::fits<Chosen>,
          &::begin<Chosen>,
          &PairLSMFriction::loop<Chosen, LSMRecordNothing>,
          &PairLSMFriction::loop<Chosen, LSMRecordEnergies>,
          &PairLSMFriction::loop<Chosen, LSMRecordAndTally>};
}

const PairLSMFriction::Law PairLSMFriction::laws[] = {
#define LSM_FRICTION_LAW(law) entry<LSM::law>(),
#include "laws/friction_laws.h"
#undef LSM_FRICTION_LAW
};

const PairLSMFriction::Law *PairLSMFriction::find_law(const std::string &name)
{
  for (const Law &one : laws)
    if (name == one.name) return &one;
  return nullptr;
}

std::string PairLSMFriction::law_names()
{
  std::string all;
  for (const Law &one : laws)
    if (find_law(one.name) == &one) all += (all.empty() ? "" : ", ") + std::string(one.name);
  return all;
}

double PairLSMFriction::near_reach() const
{
  return locate_onset ? NEAR_REACH : 0.0;
}

int PairLSMFriction::size_history() const
{
  return LAW_STATE + law->state_size;
}

/* ---------------------------------------------------------------------- */

PairLSMFriction::PairLSMFriction(LAMMPS *_lmp) :
    PairLSMFree(_lmp), pace(1.0), sites_build(-1), chosen_anew(true), noted(true), law(&laws[0]),
    running(&laws[0]), coefficient{}, given{}, restored(false), locate_onset(1), of_single{},
    fix_dummy(nullptr), fix_history(nullptr)
{
  centroidstressflag = CENTROID_NOTAVAIL;
  nondefault_history_transfer = 1;

  // a contact lost in the step in which the list is built keeps its history until its release was counted

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

/* ---------------------------------------------------------------------- */

PairLSMFriction::~PairLSMFriction()
{
  if (!fix_history)
    modify->delete_fix("NEIGH_HISTORY_LSM_DUMMY");
  else
    modify->delete_fix("NEIGH_HISTORY_LSM");
  destroy_coefficients();
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (screened) check_special();
  chosen_anew = find_near(MAX(near_reach(), 1.0), fix_history->firstflag);
  if (chosen_anew) collect_sites();
  (this->*(evflag        ? running->loop_tally
           : record_what ? running->loop_energies
                         : running->loop_nothing))();
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

/* ----------------------------------------------------------------------
   a pair without contact: the vector is kept while it is near, forgotten otherwise
------------------------------------------------------------------------- */

static inline void keep_near(bool near, double delx, double dely, bool &touch, double *h)
{
  touch = near;
  h[XI] = 0.0;
  h[DX] = near ? delx : 0.0;
  h[DY] = near ? dely : 0.0;
  h[STATUS] = near ? NEAR : STICKS;
}

/* ----------------------------------------------------------------------
   Pairs that do not touch have no memory: whether one is near follows from its vector.
------------------------------------------------------------------------- */

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

/* ----------------------------------------------------------------------
   The tangential increment is the change of the pair vector since the step before, not velocity times
   time step: ghost velocities need not be communicated, and evaluating the forces twice at the same
   positions (run after run, restart) changes nothing.
------------------------------------------------------------------------- */

template <class Law, class Recorder> void PairLSMFriction::loop()
{
  double **x = atom->x;
  double *const f = atom->f[0];
  const double *radius = contact_radii();
  const int nlocal = atom->nlocal;
  const int size = size_history();
  const double reach_sq = near_reach() * near_reach();
  [[maybe_unused]] const double dt = update->dt * pace;

  // the setup of a run evaluates the forces of a step that was done: the state of the contacts stays, so
  // that a run in pieces equals one run, and a contact that slides goes on sliding. Only where a command moved
  // particles since, by more than they are rounded when they cross a border of the box, their contacts follow.

  const bool setup = update->setupflag != 0;
  double farthest = 0.0;
  for (int c = 0; c < 2; c++)
    farthest = MAX(farthest, MAX(fabs(domain->boxlo[c]), fabs(domain->boxhi[c])));
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * farthest;
  Recorder recorder(*this, setup, domain->boxlo[0], domain->prd[0]);

  const auto evaluate = [&](int place, bool &touch) LSM_LAMBDA {
    const Site &site = sites[place];
    const int i = site.i, j = site.j, itype = site.itype, jtype = site.jtype;
    double *const h = &histories[static_cast<size_t>(place) * size];
    const double delx = near.vector(place)[0];
    const double dely = near.vector(place)[1];
    const double rsq = delx * delx + dely * dely;
    const double r0 = site.r0;
    const bool apart = rsq >= r0 * r0;
    if (apart && !touch && rsq > reach_sq * r0 * r0) return;
    if (screened && left_out(origins[place].entry, itype, jtype)) {
      touch = false;
      return;
    }

    const bool was_near = touch && h[STATUS] == NEAR;
    if (apart && (!touch || was_near)) {
      keep_near(rsq <= reach_sq * r0 * r0, delx, dely, touch, h);
      return;
    }
    const double r = sqrt(rsq);
    const double rinv = r > 0.0 ? 1.0 / r : 0.0;
    const double nx = delx * rinv, ny = dely * rinv;
    const auto c = coefficients_of<Law>(
        [this, itype, jtype](std::size_t p) { return coefficient[p][itype][jtype]; },
        parameters_of<Law>);

    LSM::FrictionContact contact{0.0, 0.0, 0.0, 0.0, false};
    bool moved = !setup;
    if (touch) {
      if (setup) moved = fabs(delx - h[DX]) > rounding || fabs(dely - h[DY]) > rounding;

      // tangent of the middle of the step, so that the increment is of second order

      const double mx = delx + h[DX], my = dely + h[DY];
      const double msq = mx * mx + my * my;
      const double minv = msq > 0.0 ? 1.0 / sqrt(msq) : 0.0;
      contact.dxi = (my * (h[DX] - delx) + mx * (dely - h[DY])) * minv;
      if constexpr (Law::needs_time) contact.time = dt;
      if (was_near) {
        const double before = sqrt(h[DX] * h[DX] + h[DY] * h[DY]);
        const double share = locate_onset ? LSM::share_in_contact(before, r, r0) : 0.0;
        contact.dxi *= share;
        if constexpr (Law::needs_time) contact.time *= share;
        h[STATUS] = STICKS;
        Law::begin(c, h + LAW_STATE);
      }
    } else {
      touch = true;
      h[XI] = 0.0;
      h[STATUS] = STICKS;
      Law::begin(c, h + LAW_STATE);
    }

    const double kij = k[itype][jtype];
    contact.fn = LSM::contact_normal_force(kij, r, r0);
    if (velocity && !apart && r > 0.0) {
      double rate;
      const double more = dashpot(i, j, delx, dely, 0.0, r, contact.fn, rate);
      contact.fn += more;
      velocity->power -= (newton_pair || j < nlocal ? 1.0 : 0.5) * more * rate;
    }
    contact.xi = h[XI];
    if constexpr (Law::needs_sliding) contact.sliding = h[STATUS] == SLIDES;
    const LSM::FrictionStep s =
        !moved && !apart ? LSM::FrictionStep{h[XI], c.kt * h[XI], 0.0, 0.0, contact.sliding}
                         : LSM::friction_step<Law>(c, contact, h + LAW_STATE);

    const bool both = newton_pair || j < nlocal;
    if constexpr (Recorder::records) {
      const double share = both ? 1.0 : 0.5;
      recorder.springs(share, apart ? 0.0 : LSM::Spring::energy(kij, r - r0),
                       LSM::Spring::energy(c.kt, s.xi));
      recorder.dissipation(share, s.dissipated);
      if (s.slip != 0.0)
        recorder.slip(share, 0.5 * (x[i][0] + x[j][0]),
                      fabs(s.slip) * LSM::contact_size(radius[i], radius[j]));
      if (recorder.wants_contacts()) {
        const double along = apart ? 0.0 : contact.fn * nx + s.force * ny;
        recorder.contact({0.5 * (x[i][0] + x[j][0]), -s.slip * fabs(ny), s.dissipated,
                          ny > 0.0 ? -along : along, share});
      }
    }

    if (apart) {
      keep_near(rsq <= reach_sq * r0 * r0, delx, dely, touch, h);
      return;
    }
    h[XI] = s.xi;
    h[DX] = delx;
    h[DY] = dely;
    if constexpr (Law::needs_sliding) h[STATUS] = s.sliding ? SLIDES : STICKS;

    const double fx = contact.fn * nx + s.force * ny;
    const double fy = contact.fn * ny - s.force * nx;
    double *const fi = f + 3 * static_cast<size_t>(i), *const fj = f + 3 * static_cast<size_t>(j);
    fi[0] += fx;
    fi[1] += fy;
    if (both) {
      fj[0] -= fx;
      fj[1] -= fy;
    }
    if constexpr (Recorder::tallies)
      ev_tally_xyz(i, j, nlocal, newton_pair,
                   LSM::Spring::energy(kij, r - r0) + LSM::Spring::energy(c.kt, s.xi), 0.0, fx, fy,
                   0.0, delx, dely, 0.0);
  };

  // The particles of contacts are far from each other in memory: their forces are fetched some contacts ahead.

  constexpr int AHEAD = 8;
  const int count = near.size();
  for (int n = 0; n < count; n++) {
    if (n + AHEAD < count) {
      const Site &site = sites[near[n + AHEAD]];
      for (const int i : {site.i, site.j}) __builtin_prefetch(f + 3 * static_cast<size_t>(i), 1);
    }
    const int place = near[n];
    const bool before = near.is_touching(place);
    bool touch = before;
    double *const h = &histories[static_cast<size_t>(place) * size];
    if (!before && !chosen_anew) {
      const double *const d = near.vector_before(place), r0 = sites[place].r0;
      keep_near(d[0] * d[0] + d[1] * d[1] <= reach_sq * r0 * r0, d[0], d[1], touch, h);
    } else if (!before)
      touch = *origins[place].touch;
    evaluate(place, touch);
    const bool after = touch && h[STATUS] != NEAR;
    if (after != before) near.set_touching(place, after);
  }
  noted = false;
  if (screened) note_contacts();    // what is left out is known only here
  recorder.finish();
}

/* ---------------------------------------------------------------------- */

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
      double values[MAX_PARAMETERS];
      for (int p = 0; p < law->count; p++) values[p] = coefficient[p][itype][jtype];
      double *const h = &fix_history->firstvalue[i][size_history() * jj];
      fix_history->firstflag[i][jj] = 1;
      h[XI] = -shear[i] / values[0];
      h[DX] = delx;
      h[DY] = dely;
      h[STATUS] = STICKS;
      law->begin(values, h + LAW_STATE);
    }
  }
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::allocate()
{
  PairLSMFree::allocate();
  create_coefficients();
}

void PairLSMFriction::create_coefficients()
{
  const int n = atom->ntypes + 1;
  for (int p = 0; p < law->count; p++) {
    memory->create(coefficient[p], n, n, "pair:coefficient");
    memory->create(given[p], n, n, "pair:given");
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        coefficient[p][i][j] = 0.0;
        given[p][i][j] = 0;
      }
  }
}

void PairLSMFriction::destroy_coefficients()
{
  for (int p = 0; p < MAX_PARAMETERS; p++) {
    memory->destroy(coefficient[p]);
    memory->destroy(given[p]);
  }
}

/* ----------------------------------------------------------------------
   another law has other coefficients, and cannot go on with the contacts of the one before
------------------------------------------------------------------------- */

void PairLSMFriction::choose(const Law *wanted)
{
  if (wanted == law) return;
  if (fix_history || restored)
    error->all(FLERR,
               "Pair style lsm/friction has contacts of the law {}{}, and cannot go on with the "
               "law {}; give 'pair_style "
               "none' and 'run 0' first to forget them",
               law->name, restored ? " from a restart file" : "", wanted->name);
  if (allocated) destroy_coefficients();
  law = running = wanted;
  if (!allocated) return;
  create_coefficients();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) setflag[i][j] = on[i][j] = 0;
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::settings(int narg, char **arg)
{
  locate_onset = 1;
  const Law *wanted = &laws[0];
  int iarg = 0;
  if (narg > 0 && strcmp(arg[0], "onset") != 0) {
    wanted = find_law(arg[0]);
    if (!wanted)
      error->all(FLERR,
                 "Pair style lsm/friction expects [LAW] [onset located|step] with one of the laws "
                 "{}, got '{}'",
                 law_names(), arg[0]);
    iarg = 1;
  }
  if (iarg < narg) {
    if (narg != iarg + 2 || strcmp(arg[iarg], "onset") != 0)
      error->all(FLERR, "Pair style lsm/friction expects [LAW] [onset located|step], got '{}'",
                 arg[iarg]);
    if (strcmp(arg[iarg + 1], "step") == 0)
      locate_onset = 0;
    else if (strcmp(arg[iarg + 1], "located") != 0)
      error->all(FLERR, "Pair lsm/friction onset is '{}', but must be located or step",
                 arg[iarg + 1]);
  }
  choose(wanted);
}

/* ----------------------------------------------------------------------
   values: those of all parameters of the law before it and of it
------------------------------------------------------------------------- */

void PairLSMFriction::check(int p, double value, const double *values,
                            const std::string &where) const
{
  const LSM::Parameter &one = law->parameters[p];
  if (one.range == LSM::Parameter::positive && !(value > 0.0))
    error->all(FLERR, "Pair lsm/friction {}{} is {}, but must be > 0", one.name, where, value);
  if (!(value >= 0.0))
    error->all(FLERR, "Pair lsm/friction {}{} is {}, but must be >= 0", one.name, where, value);
  if (one.least >= 0 && value < values[one.least])
    error->all(FLERR, "Pair lsm/friction {}{} is {}, but must be at least {} = {}", one.name, where,
               value, law->parameters[one.least].name, values[one.least]);
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::coeff(int narg, char **arg)
{
  // what is expected: 'k kt mu [mu_static]', or 'k kt mu VALUE ... [theta VALUE]'; then, maybe, 'kelvin-voigt TIME'

  const double delay_one = LSMScene::take_retardation(lmp, "Pair lsm/friction", narg, arg);

  std::string expected = "k kt";
  int required = 0;
  for (int p = 1; p < law->count; p++) {
    const LSM::Parameter &one = law->parameters[p];
    const bool optional = one.otherwise != LSM::Parameter::required;
    const std::string words = one.name + std::string(law->named ? " VALUE" : "");
    expected += optional ? " [" + words + "]" : " " + words;
    if (!optional) required++;
  }
  const std::string what = law->named ? "Pair style lsm/friction " + std::string(law->name)
                                      : "Pair style lsm/friction";
  const int each = law->named ? 2 : 1, most = 4 + each * (law->count - 1);
  const bool off_only = narg == 3;
  if (!off_only && (narg < 4 + each * required || narg > most || (narg - 4) % each))
    error->all(FLERR, "{} expects 'pair_coeff I J {} [kelvin-voigt TIME]' or 'pair_coeff I J off'",
               what, expected);
  if (!allocated) allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  if (parse_off(narg, arg, ilo, ihi, jlo, jhi)) return;
  if (off_only) error->all(FLERR, "{} expects 'off' or '{}', got '{}'", what, expected, arg[2]);

  const double k_one = utils::numeric(FLERR, arg[2], false, lmp);
  if (k_one <= 0.0) error->all(FLERR, "Pair lsm/friction k is {}, but must be > 0", k_one);
  double value[MAX_PARAMETERS];
  bool is_given[MAX_PARAMETERS] = {};
  value[0] = utils::numeric(FLERR, arg[3], false, lmp);
  is_given[0] = true;
  for (int iarg = 4, p = 1; iarg < narg; iarg += each, p++) {
    if (law->named) {
      for (p = 1; p < law->count && strcmp(arg[iarg], law->parameters[p].name) != 0; p++) {}
      if (p == law->count || is_given[p])
        error->all(FLERR, "{} expects 'pair_coeff I J {}', got {}'{}'", what, expected,
                   p == law->count ? "" : "a second ", arg[iarg]);
    }
    value[p] = utils::numeric(FLERR, arg[iarg + each - 1], false, lmp);
    is_given[p] = true;
  }
  for (int p = 0; p < law->count; p++) {
    const LSM::Parameter &one = law->parameters[p];
    if (!is_given[p]) {
      if (one.otherwise == LSM::Parameter::required)
        error->all(FLERR, "{} expects 'pair_coeff I J {}', but {} is missing", what, expected,
                   one.name);
      value[p] = one.otherwise == LSM::Parameter::as_least ? value[one.least] : one.otherwise;
    }
  }
  for (int p = 0; p < law->count; p++) check(p, value[p], value, "");

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      k[i][j] = k_one;
      delay[i][j] = delay_one;
      for (int p = 0; p < law->count; p++) {
        coefficient[p][i][j] = value[p];
        given[p][i][j] = is_given[p];
      }
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

  // forces at displaced positions would slide contacts

  if (!modify->get_fix_by_style("^numdiff").empty())
    error->all(
        FLERR,
        "Pair style lsm/friction does not work with fix numdiff, as friction depends on the path");

  pace = 1.0;
  noted = true;     // at the end of the run before
  running = law;    // see init_one()
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
                   "Pair style lsm/friction: the period of the box in {} is {:.6g}, but must be at "
                   "least {:.6g} (twice the "
                   "largest contact distance with the neighbor skin), as a pair would meet itself "
                   "on both sides",
                   c ? "y" : "x", domain->prd[c], 2.0 * reach);
  }

  // one name, whichever styles came before, so that a restart finds the history

  const std::string id_history = "NEIGH_HISTORY_LSM";
  if (!fix_history) {
    fix_history = dynamic_cast<FixNeighHistory *>(
        modify->replace_fix("NEIGH_HISTORY_LSM_DUMMY",
                            fmt::format("{} all LSM_HISTORY {} {}", id_history, size_history(),
                                        law->state_size ? law->name : ""),
                            1));
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

  // fix adapt changes coefficients and comes here again

  double value[MAX_PARAMETERS];
  for (int p = 0; p < law->count; p++) {
    const LSM::Parameter &one = law->parameters[p];
    if (!given[p][i][j] && one.otherwise == LSM::Parameter::as_least)
      coefficient[p][i][j] = coefficient[one.least][i][j];
    coefficient[p][j][i] = value[p] = coefficient[p][i][j];
  }
  if (!on[i][j]) return cut;
  const std::string types = fmt::format(" of types {} {}", i, j);
  for (int p = 0; p < law->count; p++) check(p, value[p], value, types);

  // the list has another law of the name; within a run there is no way back

  while (!running->fits(value)) {
    const Law *next = running + 1;
    if (next == std::end(laws) || strcmp(next->name, law->name) != 0)
      error->all(FLERR, "Pair lsm/friction: the law {} cannot be run with the coefficients{}",
                 law->name, types);
    running = next;
  }
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
  for (int n = STATUS; n < size_history(); n++) target[n] = source[n];
}

/* ----------------------------------------------------------------------
   A law other than the first is named in front of what the first one writes, behind a number that nothing else
   begins with.
------------------------------------------------------------------------- */

static constexpr int LAW_FOLLOWS = -1;

void PairLSMFriction::write_restart_settings(FILE *fp)
{
  if (law == &laws[0]) return;
  const int size = static_cast<int>(strlen(law->name));
  fwrite(&LAW_FOLLOWS, sizeof(int), 1, fp);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(law->name, 1, size, fp);
}

void PairLSMFriction::read_restart_settings(FILE *fp)
{
  int size = 0;
  if (comm->me == 0) {
    int mark;
    utils::sfread(FLERR, &mark, sizeof(int), 1, fp, nullptr, error);
    if (mark == LAW_FOLLOWS)
      utils::sfread(FLERR, &size, sizeof(int), 1, fp, nullptr, error);
    else
      fseek(fp, -static_cast<long>(sizeof(int)), SEEK_CUR);
  }
  MPI_Bcast(&size, 1, MPI_INT, 0, world);
  restored = true;
  if (size == 0) return;
  std::string name(size, ' ');
  if (comm->me == 0) utils::sfread(FLERR, &name[0], 1, size, fp, nullptr, error);
  MPI_Bcast(&name[0], size, MPI_CHAR, 0, world);
  law = running = find_law(name);
  if (!law)
    error->all(
        FLERR,
        "Pair style lsm/friction: the restart file has contacts of the law {}, expected one of {}",
        name, law_names());
}

void PairLSMFriction::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  PairLSMFree::write_restart(fp);
}

void PairLSMFriction::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  PairLSMFree::read_restart(fp);
}

/* ---------------------------------------------------------------------- */

void PairLSMFriction::write_coeff(FILE *fp, int i, int j)
{
  PairLSMFree::write_coeff(fp, i, j);
  for (int p = 0; p < law->count; p++) fwrite(&coefficient[p][i][j], sizeof(double), 1, fp);
}

void PairLSMFriction::read_coeff(FILE *fp, int i, int j)
{
  PairLSMFree::read_coeff(fp, i, j);
  for (int p = 0; p < law->count; p++) {
    double *value = &coefficient[p][i][j];
    if (comm->me == 0) utils::sfread(FLERR, value, sizeof(double), 1, fp, nullptr, error);
    MPI_Bcast(value, 1, MPI_DOUBLE, 0, world);
    const int least = law->parameters[p].least;
    given[p][i][j] = least < 0 || *value > coefficient[least][i][j];
  }
}

void PairLSMFriction::print_coeff(FILE *fp, int i, int j)
{
  fprintf(fp, " %.17g %.17g", k[i][j], coefficient[0][i][j]);
  for (int p = 1; p < law->count; p++) {
    if (law->named) fprintf(fp, " %s", law->parameters[p].name);
    fprintf(fp, " %.17g", coefficient[p][i][j]);
  }
}

/* ----------------------------------------------------------------------
   normal force and energy of both springs; svector = elongation of the tangential spring and the
   tangential force on i along (-ny,nx)
------------------------------------------------------------------------- */

double PairLSMFriction::single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                               double factor_lj, double &fforce)
{
  note_contacts();
  double energy = PairLSMFree::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  svector[0] = svector[1] = 0.0;
  if (fforce == 0.0) return energy;

  const double kt = coefficient[0][MIN(itype, jtype)][MAX(itype, jtype)];
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

/* ----------------------------------------------------------------------
   coefficients by their names, but not those that follow another
------------------------------------------------------------------------- */

void *PairLSMFriction::extract(const char *str, int &dim)
{
  dim = 2;
  for (int p = 0; p < law->count; p++)
    if (strcmp(str, law->parameters[p].name) == 0 &&
        law->parameters[p].otherwise != LSM::Parameter::as_least)
      return (void *) coefficient[p];
  return PairLSMFree::extract(str, dim);
}
