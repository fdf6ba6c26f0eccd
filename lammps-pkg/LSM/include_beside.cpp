// SPDX-License-Identifier: GPL-2.0-or-later

#include "include_beside.h"

#include "error.h"
#include "input.h"
#include "lsm_script.h"

using namespace LAMMPS_NS;

void IncludeBeside::command(int narg, char **arg)
{
  if (narg != 1) error->all(FLERR, "include_beside expects one file name, but got {} words", narg);
  input->one("include \"" + LSMScript::beside(lmp, infile, arg[0], "include_beside") + "\"");
}
