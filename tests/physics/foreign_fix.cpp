// SPDX-License-Identifier: GPL-2.0-or-later
// Plugin with fix bond/break of LAMMPS' package MC, which the build of the tests does not include.
#include "fix_bond_break.h"
#include "lammpsplugin.h"
#include "version.h"

using namespace LAMMPS_NS;

static Fix *make(LAMMPS *lmp, int narg, char **arg) { return new FixBondBreak(lmp, narg, arg); }

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc) {
  lammpsplugin_t plugin{};
  plugin.version = LAMMPS_VERSION;
  plugin.style = "fix";
  plugin.name = "bond/break";
  plugin.info = "fix bond/break";
  plugin.author = "LAMMPS";
  plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(&make);
  plugin.handle = handle;
  reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
}
