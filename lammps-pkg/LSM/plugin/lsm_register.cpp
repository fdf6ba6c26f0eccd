// SPDX-License-Identifier: GPL-2.0-or-later
// Registers the styles of the package with every LAMMPS of a program that links a shared library of
// LAMMPS built without them: at its start and again after 'clear'. The function defined here takes
// the place of the library's own of that name, as the dynamic linker asks the program first, and
// calls it. Not part of a package that is compiled in.

#include "force.h"
#include "input.h"
#include "lammps.h"
#include "lammpsplugin.h"
#include "modify.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc);

namespace {

void add_style(lammpsplugin_t *style, void *ptr)
{
  auto *lmp = static_cast<LAMMPS *>(ptr);
  const std::string category = style->style;
  const auto v1 = style->creator.v1;
  const auto v2 = style->creator.v2;
  if (category == "pair") (*lmp->force->pair_map)[style->name] = (Force::PairCreator) v1;
  if (category == "bond") (*lmp->force->bond_map)[style->name] = (Force::BondCreator) v1;
  if (category == "fix") (*lmp->modify->fix_map)[style->name] = (Modify::FixCreator) v2;
  if (category == "compute") (*lmp->modify->compute_map)[style->name] = (Modify::ComputeCreator) v2;
  if (category == "command") (*lmp->input->command_map)[style->name] = (Input::CommandCreator) v1;
}

}    // namespace

void LAMMPS::create()
{
  using Create = void (*)(LAMMPS *);
  static const auto of_library =
      reinterpret_cast<Create>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS6createEv"));
  if (!of_library) throw std::runtime_error("the shared library of LAMMPS has no LAMMPS::create()");
  of_library(this);
  lammpsplugin_init(this, nullptr, reinterpret_cast<void *>(&add_style));
}
