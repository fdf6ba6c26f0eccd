// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_travel.h"

#include "atom.h"
#include "domain.h"
#include "lsm_fixes.h"
#include "lsm_scene.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

void LSMTravel::look_for_movers()
{
  movers = lsm_fixes<LSMMover>(modify);
  known = update->whichflag == 1 && LSMScene::has_only_ours(modify);
}

// Before a run, and between runs that follow without a set-up, commands may have moved particles.
const std::vector<double> &LSMTravel::since_last()
{
  const bool follows = !update->setupflag && update->ntimestep == step + 1 &&
      update->firststep == first_step && update->laststep == last_step;
  step = update->ntimestep;
  first_step = update->firststep;
  last_step = update->laststep;
  if (update->setupflag) look_for_movers();
  longest.assign((atom->nlocal + LSMMover::BLOCK - 1) / LSMMover::BLOCK,
                 known && follows ? 0.0 : INFINITY);
  if (!known || !follows) return longest;
  for (const LSMMover *mover : movers)    // a particle may be moved by all of these fixes
    mover->add_longest_moves(longest);

  double largest = 0.0;    // largest coordinate, which determines the rounding of positions
  for (int c = 0; c < 3; c++)
    largest = std::max({largest, std::fabs(domain->boxlo[c]), std::fabs(domain->boxhi[c])});
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (double &move : longest) move = move * (1.0 + 16.0 * epsilon) + 2.0 * epsilon * largest;
  return longest;
}
