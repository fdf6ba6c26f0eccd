// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_absorb.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_lsm_nve.h"
#include "force.h"
#include "group.h"
#include "lsm_fixes.h"
#include "lsm_keyword_reader.h"
#include "lsm_scene.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;

FixLSMAbsorb::FixLSMAbsorb(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  has_output(&work_absorbed);

  const bool per_mass = narg == 8 && strcmp(arg[6], "per/mass") == 0;
  if (narg != 7 && !per_mass)
    error->all(FLERR,
               "Fix lsm/absorb expects 'fix ID group lsm/absorb x|y|z ZP ZS [per/mass] LENGTH': "
               "direction across the border, impedances of P- and S-waves, length (in three "
               "dimensions area) of the border for each particle, or for each unit of its mass");
  const int dimension = domain->dimension;
  const std::string axes = std::string("xyz").substr(0, dimension);
  if (strlen(arg[3]) != 1 || axes.find(arg[3][0]) == std::string::npos)
    error->all(FLERR, lsm_place(lmp, arg[3]),
               "Fix lsm/absorb direction across the border is '{}', but must be {}", arg[3],
               dimension == 3 ? "x, y or z" : "x or y");
  static constexpr const char *names[] = {"impedance of P-waves", "impedance of S-waves", "length"};
  double value[3];
  for (int n = 0; n < 3; n++) {
    const char *const word = arg[n < 2 ? 4 + n : narg - 1];
    value[n] = utils::numeric(FLERR, word, false, lmp);
    if (!(value[n] >= 0.0))
      error->all(FLERR, lsm_place(lmp, word), "Fix lsm/absorb {} is {}, but must be >= 0", names[n],
                 value[n]);
  }
  const int across = arg[3][0] - 'x';
  for (int c = 0; c < 3; c++) dashpot[c] = value[c == across ? 0 : 1] * value[2];
  of_mass = per_mass;
}

void FixLSMAbsorb::init()
{
  LSMScene::require_verlet(lmp, "Fix lsm/absorb");
  LSMScene::require_plain_units(lmp, "Fix lsm/absorb");
  if (group->count(igroup) == 0)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix lsm/absorb {}: group {} has no particles, expected those of a border", id,
               group->names[igroup]);
  borders = lsm_fixes<FixLSMAbsorb>(modify);
  integrators = lsm_fixes<FixLSMNVE>(modify);
}

// Within a run, velocities are half a step older than the forces. The dashpot acts on the velocity
// that the particle will have with the dashpot's own force included, which keeps the scheme second
// order, and stable for any impedance. In the setup, velocities and forces are of the same time.
//
// With velocity Verlet the work of a force in the two halves of the steps before and after it is
// force times the velocity of its time, so the loss is known exactly. Viscosity by fix lsm/nve
// multiplies velocities by a factor between the first half and this time, and again between this
// time and the second half.
//
// Where borders meet, the dashpots of all of them act on the same velocity, which needs their sum:
// the last of these fixes acts for all.
void FixLSMAbsorb::post_force(int /*vflag*/)
{
  if (this == borders.back()) domain->dimension == 3 ? absorb<3>() : absorb<2>();
}

// force over velocity of a particle along an axis; 0 outside of the group
inline double FixLSMAbsorb::drag(int i, int c, double mass) const
{
  if (!(atom->mask[i] & groupbit)) return 0.0;
  return of_mass ? dashpot[c] * mass : dashpot[c];
}

template <int DIM> void FixLSMAbsorb::absorb()
{
  const double half = update->setupflag ? 0.0 : 0.5 * update->dt;
  double **v = atom->v;
  double **f = atom->f;
  int bits = 0;
  for (FixLSMAbsorb *border : borders) {
    bits |= border->groupbit;
    border->work_absorbed += half * border->rate;
    border->rate = 0.0;
  }
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & bits)) continue;
    const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    const double kick = half * force->ftm2v / mass;
    double decay = 1.0;
    for (const FixLSMNVE *integrator : integrators)
      if (atom->mask[i] & integrator->groupbit)
        decay *= integrator->decay_in_half_step(atom->type[i]);
    const double reached = update->setupflag ? 1.0 : decay;
    double drag[DIM] = {}, before[DIM];    // before: velocity of this time but for the decay
    for (const FixLSMAbsorb *border : borders)
      for (int c = 0; c < DIM; c++) drag[c] += border->drag(i, c, mass);
    for (int c = 0; c < DIM; c++) {
      before[c] = (v[i][c] + kick * f[i][c]) / (1.0 + kick * drag[c] * reached);
      f[i][c] -= drag[c] * reached * before[c];
    }
    for (FixLSMAbsorb *border : borders) {
      double lost = 0.0;
      for (int c = 0; c < DIM; c++) lost += border->drag(i, c, mass) * before[c] * before[c];
      border->work_absorbed += half * reached * lost;
      border->rate += reached * reached * decay * lost;
    }
  }
}
