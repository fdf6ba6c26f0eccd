// SPDX-License-Identifier: GPL-2.0-or-later

#include "fix_lsm_absorb.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "lsm_scene.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;

FixLSMAbsorb::FixLSMAbsorb(LAMMPS *_lmp, int narg, char **arg) : LSMKeptFix(_lmp, narg, arg)
{
  has_output(&work_absorbed);

  if (narg != 7)
    error->all(FLERR,
               "Fix lsm/absorb expects 'fix ID group lsm/absorb x|y ZP ZS LENGTH': direction "
               "across the border, impedances of P- and S-waves, length of the border for "
               "each particle");
  if (strcmp(arg[3], "x") != 0 && strcmp(arg[3], "y") != 0)
    error->all(FLERR, "Fix lsm/absorb direction across the border is '{}', but must be x or y",
               arg[3]);
  static constexpr const char *names[] = {"impedance of P-waves", "impedance of S-waves", "length"};
  double value[3];
  for (int n = 0; n < 3; n++) {
    value[n] = utils::numeric(FLERR, arg[4 + n], false, lmp);
    if (!(value[n] >= 0.0))
      error->all(FLERR, "Fix lsm/absorb {} is {}, but must be >= 0", names[n], value[n]);
  }
  const int across = arg[3][0] == 'x' ? 0 : 1;
  dashpot[across] = value[0] * value[2];
  dashpot[1 - across] = value[1] * value[2];
}

void FixLSMAbsorb::init()
{
  LSMScene::require_plane(lmp, "Fix lsm/absorb");
}

// Within a run, velocities are half a step older than the forces. The dashpot acts on the velocity
// that the particle will have with the dashpot's own force included, which keeps the scheme second
// order, and stable for any impedance. In the setup, velocities and forces are of the same time.
//
// With velocity Verlet the work of a force in the two halves of the steps before and after it is
// force times the velocity of its time, so the loss is known exactly.
void FixLSMAbsorb::post_force(int /*vflag*/)
{
  const double half = update->setupflag ? 0.0 : 0.5 * update->dt;
  double **v = atom->v;
  double **f = atom->f;
  double lost = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double kick =
        half * force->ftm2v / (atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]]);
    for (int c = 0; c < 2; c++) {
      const double now = (v[i][c] + kick * f[i][c]) / (1.0 + kick * dashpot[c]);
      f[i][c] -= dashpot[c] * now;
      lost += dashpot[c] * now * now;
    }
  }
  work_absorbed += half * (rate + lost);
  rate = lost;
}
