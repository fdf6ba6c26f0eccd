// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_nve.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/text.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "group.h"
#include "integrate.h"
#include "lsm_fixes.h"
#include "lsm_keyword_reader.h"
#include "lsm_link_kernel.h"
#include "lsm_ranks.h"
#include "lsm_scene.h"
#include "math_eigen.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr double NEARLY_CLOSED =
    1.05;    // distance over sum of radii of contacts that may close soon

FixLSMNVE::FixLSMNVE(LAMMPS *_lmp, int narg, char **arg) :
    LSMKeptFix(_lmp, narg, arg), nu(atom->ntypes + 1, 0.0), decay(atom->ntypes + 1, 1.0)
{
  time_integrate = 1;
  dynamic_group_allow = 1;
  has_output(&work_viscosity, 2);
  comm_reverse = 6;

  LSMKeywordReader in(lmp, "Fix lsm/nve", 3, narg, arg);
  const auto set = [&](int lo, int hi) {
    std::fill(&nu[lo], &nu[hi] + 1, in.number(LSM::Must::not_negative));
  };
  const auto set_all = [&] {
    set(1, atom->ntypes);
  };
  const auto set_types = [&] {
    int lo, hi;
    utils::bounds(FLERR, in.text(), 1, atom->ntypes, lo, hi, error);
    set(lo, hi);
  };
  in.read_all({{"viscosity", LSM::Action{1, set_all}},
               {"viscosity/type", LSM::Action{2, set_types}},
               {"dtcheck", LSM::Words{&check, {"error", "warn", "off"}}}});
  for (double value : nu) viscous = viscous || value > 0.0;
}

FixLSMNVE::~FixLSMNVE()
{
  leave_clearing_to_integrator();
}

std::string FixLSMNVE::viscosity() const
{
  const bool same = std::all_of(nu.begin() + 1, nu.end(), [this](double value) {
    return value == nu[1];
  });
  std::string text = LSM::text::number(nu[1]);
  for (size_t itype = 2; !same && itype < nu.size(); itype++)
    text += " " + LSM::text::number(nu[itype]);
  return text;
}

int FixLSMNVE::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR | PRE_FORCE | POST_RUN;
}

void FixLSMNVE::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/nve does not work with run_style respa");
  LSMScene::refuse_changing_radii(lmp, "Fix lsm/nve");
  LSMScene::set_up_next_run(lmp);
  is_set_up = false;
  if (viscous) LSMScene::require_plain_units(lmp, "Fix lsm/nve viscosity");
  leave_clearing_to_integrator();    // a run that ended in an error has not
  reset_dt();
}

void FixLSMNVE::reset_dt()
{
  dtv = update->dt;
  dtf = 0.5 * update->dt * force->ftm2v;
  for (int itype = 1; itype <= atom->ntypes; itype++)
    decay[itype] = exp(-0.5 * MAX(nu[itype], nu_least) * update->dt);
  collect();
}

void FixLSMNVE::raise_viscosity(double least)
{
  if (least == nu_least) return;
  complete_step();    // a deferred half step has the old viscosity
  nu_least = least;
  reset_dt();
  if (initial_chosen) choose();
}

// collects stretches of particles of the group in memory, and half a time step over the mass of
// each
void FixLSMNVE::collect()
{
  const int nlocal = atom->nlocal;
  stretches.clear();
  half_kick.resize(nlocal);
  for (int i = 0; i < nlocal; i++) {
    half_kick[i] = dtf / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    if (!(atom->mask[i] & groupbit)) continue;
    const double factor = decay[atom->type[i]];
    if (i % BLOCK == 0 || stretches.empty() || stretches.back().last != i ||
        stretches.back().decay != factor)
      stretches.push_back({i, i, factor, INFINITY});
    stretches.back().last = i + 1;
  }
  others.clear();
  int from = 0;
  for (const Stretch &stretch : stretches) {
    if (stretch.first > from) others.push_back({from, stretch.first});
    from = stretch.last;
  }
  if (nlocal > from) others.push_back({from, nlocal});
}

template <int DIM, FixLSMNVE::Kind KIND, bool CLEARS> void FixLSMNVE::set_kernels()
{
  initial_chosen = &FixLSMNVE::move<INITIAL, DIM, KIND, CLEARS>;
  final_chosen = &FixLSMNVE::move < FINAL, DIM, KIND == ANY ? ANY : PLAIN, false > ;
  both_chosen = &FixLSMNVE::move<FINAL | INITIAL, DIM, KIND, CLEARS>;
}

// most scenes need kernels without decisions for each particle
template <int DIM> void FixLSMNVE::choose_for()
{
  if (counts_work())
    set_kernels<DIM, ANY, true>();
  else if (ahead)
    clears ? set_kernels<DIM, AHEAD, true>() : set_kernels<DIM, AHEAD, false>();
  else
    clears ? set_kernels<DIM, PLAIN, true>() : set_kernels<DIM, PLAIN, false>();
}

void FixLSMNVE::choose()
{
  domain->dimension == 3 ? choose_for<3>() : choose_for<2>();
  if (counts_work()) both_chosen = nullptr;

  // fixes that may read velocities between the end of a step and the beginning of the next
  velocity_readers.clear();
  for (const auto &other : modify->get_fix_list()) {
    if (LSMScene::is_ours(other)) continue;
    const int when = modify->get_fix_mask(other);
    if (when & (INITIAL_INTEGRATE | FINAL_INTEGRATE)) both_chosen = nullptr;
    if (when & END_OF_STEP) velocity_readers.push_back(other);
  }
  if (group->dynamic[igroup]) both_chosen = nullptr;
}

void FixLSMNVE::setup(int /*vflag*/)
{
  is_set_up = true;
  ahead = FixLSMVelocity::in_use(lmp);
  choose();

  if (check == OFF) return;
  const std::string foreign = LSMScene::foreign_forces(force);
  if (!foreign.empty() && comm->me == 0)
    error->warning(FLERR,
                   "Fix lsm/nve {}: the stability limit of the time step does not include {}", id,
                   foreign);
  dt_limit = time_step_limit(NEARLY_CLOSED, omega);
  const bool was_continued = continued;
  continued = continued || !LSMScene::is_rerun(lmp);
  if (dt_limit == 0.0 || update->dt <= dt_limit) return;
  const std::string what = ahead ? "links and contacts with kelvin-voigt" : "links and contacts";

  // nearly closed contacts may refuse the start of a run, but not its continuation
  if (was_continued && check == ERROR) {
    double frequency;
    const double closed = time_step_limit(1.0, frequency);
    if (closed == 0.0 || update->dt <= closed) {
      if (comm->me == 0)
        error->warning(
            FLERR,
            "Time step {} is above the stability limit {:.6g} with the contacts that are nearly "
            "closed, below that of the closed ones, {:.6g}; the run continues",
            update->dt, dt_limit, closed > 0.0 ? closed : INFINITY);
      return;
    }
  }
  if (check == ERROR)
    error->all(FLERR, Error::NOLASTLINE,
               "Time step {} is above the stability limit {:.6g} of the {} ({}highest frequency "
               "{:.6g}); use a smaller time step or fix lsm/nve dtcheck warn",
               update->dt, dt_limit, what, ahead ? "" : "2 / ", omega);
  if (comm->me == 0)
    error->warning(FLERR, "Time step {} is above the stability limit {:.6g} of the {}", update->dt,
                   dt_limit, what);
}

// Viscosity by Strang splitting: exact decay of the velocities for half a step before and after the
// velocity Verlet step. Second order, stable for any viscosity, and the work it takes is known
// exactly.
//
// Extrapolated velocities: dashpots of links and contacts need velocities of the time of the
// forces, which are known only after the kick by these forces. They are extrapolated with the
// forces of the step before, that is, linearly through the velocities of the last two half steps,
// which is of second order and needs no further storage.
template <int PARTS, int DIM, FixLSMNVE::Kind KIND, bool CLEARS> void FixLSMNVE::move()
{
  using Motion = LSMLinkKernel::Motion<DIM>;
  const bool work = KIND == ANY && counts_work(), clear = CLEARS && (KIND != ANY || clears);
  const double dt =
      dtv;    // a copy, as the compiler must assume that stores of positions change the member
  for (Stretch &stretch : stretches) {
    const double factor = stretch.decay;
    double lost = 0.0, most = 0.0;
    double *x = atom->x[stretch.first];
    double *v = atom->v[stretch.first];
    double *f = atom->f[stretch.first];
    double *next = nullptr;
    if constexpr (KIND != PLAIN && (PARTS & INITIAL) != 0)
      if (ahead) next = ahead->now(stretch.first);
    const double *kick = &half_kick[stretch.first];
    const double *const end = &half_kick[0] + stretch.last;

    for (; kick < end; kick++, x += 3, v += 3, f += 3) {
      // all is read before anything is stored, which might change it for all that the compiler knows
      double w[DIM], push[DIM], vsq = 0.0;
      for (int c = 0; c < DIM; c++) w[c] = v[c];
      for (int c = 0; c < DIM; c++) push[c] = *kick * f[c];
      if constexpr (PARTS & FINAL) {
        for (int c = 0; c < DIM; c++) w[c] += push[c];
        if (work)
          for (int c = 0; c < DIM; c++) vsq += w[c] * w[c];
        for (int c = 0; c < DIM; c++) w[c] *= factor;
      }
      if constexpr (PARTS & INITIAL) {
        if (work)
          for (int c = 0; c < DIM; c++) vsq += w[c] * w[c];
        for (int c = 0; c < DIM; c++) w[c] *= factor;
        for (int c = 0; c < DIM; c++) w[c] += push[c];
        double square = 0.0;
        for (int c = 0; c < DIM; c++) square += w[c] * w[c];
        most = MAX(most, square);
        double to[DIM];
        for (int c = 0; c < DIM; c++) to[c] = x[c] + dt * w[c];
        double then[DIM];
        for (int c = 0; c < DIM; c++) then[c] = (w[c] + push[c]) * factor;
        for (int c = 0; c < DIM; c++) x[c] = to[c];
        if (KIND == AHEAD || next) {
          for (int c = 0; c < DIM; c++) next[c] = then[c];
          if constexpr (Motion::HAS_POSITION)
            for (int c = 0; c < DIM; c++) next[Motion::POSITION + c] = to[c];
          next += Motion::SIZE;
        }
      }
      for (int c = 0; c < DIM; c++) v[c] = w[c];
      if (clear)
        for (int c = 0; c < 3; c++) f[c] = 0.0;
      if (work) lost += dtf / *kick * vsq;
    }
    if (work) work_viscosity += 0.5 * (1.0 - factor * factor) * lost;
    if constexpr (PARTS & INITIAL) stretch.fastest = most;
  }
}

void FixLSMNVE::add_longest_moves(std::vector<double> &of_blocks) const
{
  for (auto stretch = stretches.begin(); stretch != stretches.end();) {
    const int block = stretch->first / BLOCK;
    double most = 0.0;
    for (; stretch != stretches.end() && stretch->first / BLOCK == block; ++stretch)
      most = MAX(most, stretch->fastest);
    of_blocks[block] += dtv * sqrt(most);
  }
}

void FixLSMNVE::initial_integrate(int /*vflag*/)
{
  if (!is_set_up)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix lsm/nve {}: a command of 'run ... every' has initialized LAMMPS, so that the "
               "rest of the run needs a set-up; leave out 'pre no'",
               id);
  if (group->dynamic[igroup]) collect();
  (this->*(pending ? both_chosen : initial_chosen))();
  pending = false;
}

// The second half kick of a step is deferred to the first one of the next, so that both take one
// pass through memory, unless another fix may read the velocities in between. The operations and
// their order are the same either way.
void FixLSMNVE::final_integrate()
{
  const bigint step = update->ntimestep;
  pending = both_chosen && step != output->next && step != update->laststep;
  for (const Fix *other : velocity_readers)
    if (step % other->nevery == 0) pending = false;
  if (pending) return;
  if (group->dynamic[igroup]) collect();
  (this->*final_chosen)();
}

// Whether forces may be cleared early: no other fix reads or adds forces between the beginning of a
// step and the interactions, and none needs the torques that the integrator would clear, too
bool FixLSMNVE::may_clear() const
{
  if (strcmp(update->integrate_style, "verlet") != 0 || group->dynamic[igroup] ||
      neighbor->includegroup || atom->avec->forceclearflag ||
      lsm_fixes<FixLSMNVE>(modify).size() > 1 || !LSMScene::foreign_forces(force).empty())
    return false;
  constexpr int LOOKS = INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | POST_FORCE;
  for (const auto &other : modify->get_fix_list())
    if (!LSMScene::is_ours(other) && (modify->get_fix_mask(other) & LOOKS)) return false;
  return true;
}

// Integrate::external_force_clear exists for this purpose, but no fix of LAMMPS uses it: only
// classes derived from Integrate may name it.
struct Clearing : public Integrate {
  static void is_external(Integrate *integrate, int yes)
  {
    integrate->*(&Clearing::external_force_clear) = yes;
  }
};

void FixLSMNVE::leave_clearing_to_integrator()
{
  // When LAMMPS exits, update is destroyed before its fixes.
  if (clears && update && update->integrate) Clearing::is_external(update->integrate, 0);
  clears = false;
}

static void set_to_zero(double **of, int first, int last)
{
  if (last > first) memset(of[first], 0, sizeof(double) * 3 * (last - first));
}

void FixLSMNVE::clear_all()
{
  const int count = atom->nlocal + (force->newton ? atom->nghost : 0);
  set_to_zero(atom->f, 0, count);
  if (atom->torque_flag) set_to_zero(atom->torque, 0, count);
}

void FixLSMNVE::setup_pre_force(int /*vflag*/)
{
  leave_clearing_to_integrator();
  clears = may_clear();
  if (!clears) return;
  Clearing::is_external(update->integrate, 1);
  clear_all();
}

// Clears the forces that are not cleared as particles move, and all of them after neighbor lists
// were built, as particles have other indices then.

void FixLSMNVE::pre_force(int /*vflag*/)
{
  if (!clears) return;
  if (neighbor->ago == 0) {
    clear_all();
    return;
  }
  for (const auto &between : others) set_to_zero(atom->f, between.first, between.second);
  if (force->newton) set_to_zero(atom->f, atom->nlocal, atom->nlocal + atom->nghost);
}

void FixLSMNVE::complete_step()
{
  if (pending) (this->*final_chosen)();
  pending = false;
}

void FixLSMNVE::post_run()
{
  complete_step();
  leave_clearing_to_integrator();
}

// Bound of the time step and of the highest frequency of the network of links and contacts; 0
// without springs. Pairs closer than reach_factor times the contact distance count as contacts.
//
// With velocities extrapolated linearly from those of two half steps, the scheme is stable while
// dt^2 w^2 + 4 dt g < 4 for all motions, where w^2 and g are the Rayleigh quotients of stiffness
// and viscosity over mass: the recurrence of the oscillator has its first root of modulus 1 there,
// at -1. Bounds of both bound it.
double FixLSMNVE::time_step_limit(double reach_factor, double &frequency)
{
  const double w2 = largest_eigenvalue(reach_factor, false);
  frequency = sqrt(w2);
  const double g = ahead ? largest_eigenvalue(reach_factor, true) : 0.0;
  return w2 > 0.0 ? 2.0 / (sqrt(g * g + w2) + g) : 0.0;
}

// Bound of the largest eigenvalue of stiffness (or viscosity) over mass, the smaller of two. In
// each spring (u_i - u_j)^2 <= (1 + c) u_i^2 + (1 + 1/c) u_j^2 for any c > 0, after which each
// particle stands alone. With c = 1 this is the bound by which create_lsm_fault massstep raises
// masses (fault/packing.h); with c^2 = m_i / m_j it is closer where masses are not raised.
double FixLSMNVE::largest_eigenvalue(double reach_factor, bool viscous)
{
  return std::min(largest_eigenvalue(reach_factor, viscous, 0.0),
                  largest_eigenvalue(reach_factor, viscous, 0.5));
}

// c is this power of m_i / m_j
double FixLSMNVE::largest_eigenvalue(double reach_factor, bool viscous, double power)
{
  const auto mass = [this](int i) {
    return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
  };
  alone.assign(comm_reverse * (atom->nlocal + atom->nghost), 0.0);
  LSMScene::for_each_spring(lmp, reach_factor, [&](const LSMScene::Spring &s) {
    const double along = viscous ? s.viscosity : s.k, across = viscous ? 0.0 : s.kt;
    const auto add = [&](int i, int j) {
      const double share = (1.0 + pow(mass(i) / mass(j), power)) / mass(i);
      double *const m = &alone[comm_reverse * i];
      for (int n = 0; n < 3; n++) {
        m[n] += share * (along - across) * s.n[n] * s.n[n];
        if (n < domain->dimension) m[n] += share * across;
        m[n + 3] += share * (along - across) * s.n[n] * s.n[(n + 1) % 3];
      }
    };
    add(s.i, s.j);
    if (s.both) add(s.j, s.i);
  });
  if (force->newton) comm->reverse_comm(this);
  double most = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const m = &alone[comm_reverse * i];
    const double matrix[3][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}};
    double values[3], vectors[3][3];
    MathEigen::jacobi3(matrix, values, vectors);
    most = MAX(most, values[0]);
  }
  std::vector<double>().swap(alone);
  return lsm_largest(most, world);
}

int FixLSMNVE::pack_reverse_comm(int n, int first, double *buf)
{
  std::copy_n(alone.data() + first * comm_reverse, n * comm_reverse, buf);
  return n * comm_reverse;
}

void FixLSMNVE::unpack_reverse_comm(int n, int *list, double *buf)
{
  int m = 0;
  for (int i = 0; i < n; i++)
    for (int c = 0; c < comm_reverse; c++) alone[list[i] * comm_reverse + c] += buf[m++];
}

void FixLSMNVE::restart(char *buf)
{
  LSMKeptFix::restart(buf);
  continued = true;
}
