// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_plates.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/parameters.h"
#include "fix_lsm_nve.h"
#include "fix_lsm_velocity.h"
#include "force.h"
#include "group.h"
#include "lsm_fixes.h"
#include "lsm_keyword_reader.h"
#include "lsm_scene.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

enum { LOWER, UPPER };

FixLSMPlates::FixLSMPlates(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  has_output(&work_mine, 10);

  if (narg < 5)
    error->all(FLERR,
               "Fix lsm/plates expects 'fix ID group lsm/plates lower-group upper-group "
               "keyword value ...'");
  for (int p : {LOWER, UPPER}) {
    plate[p].group = group->find(arg[3 + p]);
    if (plate[p].group < 0)
      error->all(FLERR, lsm_place(lmp, arg[3 + p]), "Fix lsm/plates {} group '{}' does not exist",
                 p ? "upper" : "lower", arg[3 + p]);
    plate[p].bit = group->bitmask[plate[p].group];
    plate[p].side = p == LOWER ? -1.0 : 1.0;
  }

  using LSM::Must;
  bool has_normal = false;
  LSMKeywordReader in(lmp, "Fix lsm/plates", 5, narg, arg);
  const auto hold = [&](bool by_stress) {
    if (by_stress) stress = in.number(Must::not_negative);
    servo = by_stress;
    has_normal = true;
  };
  in.read_all({{"velocity", &speed},
               {"ramp", &ramp, Must::not_negative},
               {"stress",
                LSM::Action{1,
                            [&] {
                              hold(true);
                            }}},
               {"stressramp", &stress_ramp, Must::not_negative},
               {"damping", &damping, Must::not_negative},
               {"impedance", &impedance, Must::not_negative},
               {"position", LSM::Action{0, [&] {
                                          hold(false);
                                        }}}});
  if (!has_normal)
    error->all(FLERR,
               "Fix lsm/plates needs either 'stress value' (normal stress held) or "
               "'position' (plates do not move across the fault)");
}

FixLSMPlates::~FixLSMPlates()
{
  // after an error between two steps a sum may still be in transit, on all ranks
  if (reducing) MPI_Wait(&request, MPI_STATUS_IGNORE);
}

LSM::files::Parameters FixLSMPlates::settings() const
{
  using LSM::text::number;
  return {{"hold", servo ? "stress" : "position"},
          {"stress", servo ? number(stress) : ""},
          {"impedance", servo ? number(impedance) : ""},
          {"velocity", number(speed)}};
}

int FixLSMPlates::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR | POST_RUN;
}

void FixLSMPlates::init()
{
  LSMScene::require_verlet(lmp, "Fix lsm/plates");
  LSMScene::require_plain_units(lmp, "Fix lsm/plates");
  if (!domain->xperiodic || domain->yperiodic || !domain->zperiodic)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix lsm/plates needs a box that is periodic in x and z and not in y "
               "(boundary p f p)");

  if (const tagint shared = in_both(plate[LOWER].bit, plate[UPPER].bit))
    error->all(FLERR, Error::NOLASTLINE, "Fix lsm/plates: atom {} is in both plates", shared);

  // the plates take over the velocity of their particles across the fault, so that one fix can
  // follow another; from one run to the next and in restarts the fix keeps it itself
  for (int p : {LOWER, UPPER}) {
    plate[p].mass = group->mass(plate[p].group);
    if (plate[p].mass <= 0.0)
      error->all(FLERR, Error::NOLASTLINE,
                 "Fix lsm/plates: the {} plate (group '{}') has no particles",
                 p ? "upper" : "lower", group->names[plate[p].group]);
    double velocity[3];
    group->vcm(plate[p].group, plate[p].mass, velocity);
    if (!servo)
      plate[p].vy = 0.0;
    else if (!vy_known)
      plate[p].vy = velocity[1];
  }
  if (update->whichflag == 1 && !LSMScene::is_rerun(lmp))
    vy_known = true;    // velocities may still be set before the first run

  integrators = lsm_fixes<FixLSMNVE>(modify);

  for (const auto &other : modify->get_fix_list())
    if (other != this && (other->time_integrate || strcmp(other->style, style) == 0)) {
      const auto twin = dynamic_cast<FixLSMPlates *>(other);
      if (in_both(twin ? twin->moved_bits() : other->groupbit, moved_bits()))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Particles of the plates of fix {} are moved by fix {} as well; take them out of "
            "the group of that fix",
            id, other->id);
    }
}

// returns the largest ID of the particles that are in one of `some` and in one of `others`, or 0
tagint FixLSMPlates::in_both(int some, int others) const
{
  tagint mine = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & some) && (atom->mask[i] & others)) mine = MAX(mine, atom->tag[i]);
  return lsm_largest(mine, world);
}

void FixLSMPlates::post_neighbor()
{
  for (Plate &p : plate) {
    p.atoms.clear();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & p.bit) p.atoms.push_back(i);

    // sorted by ID, so that a run that continues from a restart file sums in the same order
    std::sort(p.atoms.begin(), p.atoms.end(), [this](int a, int b) {
      return atom->tag[a] < atom->tag[b];
    });
  }
}

// the driving velocity at a time, with its linear ramp
double FixLSMPlates::velocity_at(double t) const
{
  return loading * (t < ramp ? speed * t / ramp : speed);
}

double FixLSMPlates::stress_at(double t) const
{
  return t < stress_ramp ? stress * t / stress_ramp : stress;
}

// sums the force of the blocks on the plates; only the motion across the fault needs it from all
// ranks
void FixLSMPlates::start_sum()
{
  double **f = atom->f;
  for (int p : {LOWER, UPPER}) {
    double fx = 0.0, fy = 0.0;
    for (int i : plate[p].atoms) {
      fx += f[i][0];
      fy += f[i][1];
    }
    plate[p].fx = fx;
    across_mine[p] = across[p] = fy;
  }
  reducing = servo && comm->nprocs > 1;
  if (reducing) MPI_Iallreduce(across_mine, across, 2, MPI_DOUBLE, MPI_SUM, world, &request);
}

void FixLSMPlates::finish_sum()
{
  if (reducing) MPI_Wait(&request, MPI_STATUS_IGNORE);
  reducing = false;
  plate[LOWER].fy = across[LOWER];
  plate[UPPER].fy = across[UPPER];
}

void FixLSMPlates::setup(int /*vflag*/)
{
  ahead = FixLSMVelocity::in_use(lmp);
  start_sum();
  finish_sum();
  for (const Plate &p : plate)
    for (int i : p.atoms) {
      atom->v[i][0] = p.side * velocity_at(elapsed);
      atom->v[i][1] = p.vy;
      if (domain->dimension == 3) atom->v[i][2] = 0.0;
    }
}

// Shear, along x: prescribed, the particles move with the velocity of the middle of the step, and
// in three dimensions not along z, where their velocity stays 0 after the setup. Across the fault:
// Newton's law for the rigid plate under the applied stress, the force of the block and the
// damping, velocity Verlet with the same splitting as fix lsm/nve. Work: trapezoidal rule over the
// step.
void FixLSMPlates::initial_integrate(int /*vflag*/)
{
  if (pending) finish_step();
  const double dt = update->dt;
  const double dux = dt * velocity_at(elapsed + 0.5 * dt);
  const double vx = dux / dt;
  double **x = atom->x;
  double **v = atom->v;
  longest = 0.0;

  for (Plate &p : plate) {
    double duy = 0.0;
    if (servo) {
      damp(p);
      p.vy += half_kick(p);
      duy = dt * p.vy;
      if (comm->me == 0)
        work_mine += -p.side * 0.5 * (stress_at(elapsed) + stress_at(elapsed + dt)) * area() * duy;
    }
    double now[3] = {p.side * velocity_at(elapsed + dt), p.vy, 0.0};
    if (servo && ahead) now[1] = (p.vy + half_kick(p)) * decay_of(p);
    p.uy += duy;
    longest = MAX(longest, sqrt(dux * dux + duy * duy));
    work_mine -= 0.5 * p.fx * p.side * dux;
    for (int i : p.atoms) {
      v[i][0] = p.side * vx;
      v[i][1] = p.vy;
      x[i][0] += p.side * dux;
      x[i][1] += duy;
      if (ahead) ahead->set(i, now);
    }
  }
  ux += dux;
}

// While the sum of the forces over all ranks is being communicated, particles of the blocks move on
// if fix lsm/nve has deferred its second half kick (see there), as then no fix reads velocities.
void FixLSMPlates::final_integrate()
{
  moved = update->dt * velocity_at(elapsed + 0.5 * update->dt);
  elapsed += update->dt;
  along = velocity_at(elapsed);
  start_sum();
  pending = true;
  bool in_time = reducing && !integrators.empty();
  for (const auto *p : integrators) in_time = in_time && p->has_put_off();
  if (!in_time) complete_step();
}

void FixLSMPlates::finish_step()
{
  pending = false;
  finish_sum();
  for (Plate &p : plate) {
    work_mine -= 0.5 * p.fx * p.side * moved;
    if (servo) {
      p.vy += half_kick(p);
      damp(p);
    }
  }
}

void FixLSMPlates::complete_step()
{
  if (!pending) return;
  finish_step();
  double **v = atom->v;
  for (const Plate &p : plate)
    for (int i : p.atoms) {
      v[i][0] = p.side * along;
      v[i][1] = p.vy;
    }
}

// returns the change of the velocity across the fault in half a step by the applied stress and the
// force of the block
double FixLSMPlates::half_kick(const Plate &p) const
{
  return 0.5 * update->dt * (-p.side * stress_at(elapsed) * area() + p.fy) / p.mass;
}

void FixLSMPlates::damp(Plate &p)
{
  const double before = p.kinetic();
  p.vy *= decay_of(p);
  if (comm->me == 0) work_mine -= before - p.kinetic();
}

// length, in three dimensions area, of a plate
double FixLSMPlates::area() const
{
  return domain->prd[0] * (domain->dimension == 3 ? domain->prd[2] : 1.0);
}

// factor of the velocity across the fault in half a step
double FixLSMPlates::decay_of(const Plate &p) const
{
  return exp(-0.5 * (damping + impedance * area() / p.mass) * update->dt);
}

// scalar = work of the plates
// vector = mean shear stress, mean normal stress, their ratio, shear stress lower and upper, normal
// stress lower and upper, shear displacement of the plates against each other, approach of the
// plates, kinetic energy of their motion across the fault
double FixLSMPlates::compute_scalar()
{
  complete_step();
  return LSMKeptFix::compute_scalar();
}

double FixLSMPlates::compute_vector(int n)
{
  complete_step();
  double mine[4] = {plate[LOWER].fx, plate[LOWER].fy, plate[UPPER].fx, plate[UPPER].fy}, sums[4];
  if (servo && comm->me != 0) mine[1] = mine[3] = 0.0;    // already the sum over all ranks
  MPI_Allreduce(mine, sums, 4, MPI_DOUBLE, MPI_SUM, world);
  const double size = area();
  const double shear_lower = sums[0] / size, shear_upper = -sums[2] / size;
  const double normal_lower = -sums[1] / size, normal_upper = sums[3] / size;
  const double shear = 0.5 * (shear_lower + shear_upper);
  const double normal = 0.5 * (normal_lower + normal_upper);
  const double values[] = {shear,        normal,      normal != 0.0 ? shear / normal : 0.0,
                           shear_lower,  shear_upper, normal_lower,
                           normal_upper, 2.0 * ux,    plate[LOWER].uy - plate[UPPER].uy,
                           kinetic()};
  return values[n];
}

void FixLSMPlates::write_restart(FILE *fp)
{
  complete_step();
  LSMKeptFix::write_restart(fp);
}

void FixLSMPlates::restart(char *buf)
{
  LSMKeptFix::restart(buf);
  vy_known = true;
}
