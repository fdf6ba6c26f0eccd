/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "lsm_mover.h"

#include "fix.h"
#include "modify.h"

using namespace LAMMPS_NS;

std::vector<LSMMover *> LSMMover::all(Modify *modify)
{
  std::vector<LSMMover *> movers;
  for (const auto &fix : modify->get_fix_list())
    if (auto p = dynamic_cast<LSMMover *>(fix)) movers.push_back(p);
  return movers;
}

void LSMMover::complete_steps(Modify *modify)
{
  for (auto *p : all(modify)) p->complete_step();
}
