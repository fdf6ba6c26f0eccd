// SPDX-License-Identifier: GPL-2.0-or-later
// Registers every style of the package with a LAMMPS that loads it by 'plugin load lsmplugin.so'.
// This file belongs to the plugin only: in a compiled-in package LAMMPS finds the styles itself.

#include "lammpsplugin.h"
#include "version.h"

#include "force.h"

#include <mpi.h>

#include <cstdio>
#include <dlfcn.h>
#include <string>
#include <type_traits>

#include "lsm_styles.h"
#include "lsm_version.h"

using namespace LAMMPS_NS;

namespace {

// The factories must return the base class: LAMMPS calls them through a pointer of that type.
template <class Base, class Style, class... Arguments>
Base *make(LAMMPS *lmp, Arguments... arguments)
{
  return new Style(lmp, arguments...);
}

class Registrar {
 public:
  Registrar(void *lmp, void *handle, void *regfunc) :
      lmp_(lmp), register_(reinterpret_cast<lammpsplugin_regfunc>(regfunc))
  {
    plugin_.version = LAMMPS_VERSION;
    plugin_.author = "the LSM package " LSM_VERSION;
    plugin_.handle = handle;
  }

  template <class Base, class Style>
  void add(const char *category, const char *name, const char *info)
  {
    if constexpr (std::is_constructible_v<Style, LAMMPS *, int, char **>)
      plugin_.creator.v2 =
          reinterpret_cast<lammpsplugin_factory2 *>(&make<Base, Style, int, char **>);
    else
      plugin_.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(&make<Base, Style>);
    plugin_.style = category;
    plugin_.name = name;
    plugin_.info = info;
    (*register_)(&plugin_, lmp_);
  }

 private:
  void *lmp_;
  lammpsplugin_regfunc register_;
  lammpsplugin_t plugin_{};
};

// Before the versions are known to be equal, only functions of LAMMPS' C library interface may be
// called: no class need look as it did when this file was compiled.

template <class Function> Function in_program(const char *name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

/// '4 Feb 2025' for the number 20250204 of lammps_version().
std::string name_of(int number)
{
  static const char *const months[] = {"?",   "Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                       "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return std::to_string(number % 100) + " " + months[number / 100 % 100 % 13] + " " +
      std::to_string(number / 10000);
}

std::string sizes(int big, int tag, int image)
{
  const auto bits = [](int bytes) {
    return std::to_string(8 * bytes);
  };
  return "bigint, tagint and imageint of " + bits(big) + ", " + bits(tag) + " and " + bits(image) +
      " bits";
}

/// What keeps the styles from this LAMMPS, or "".
std::string mismatch(void *lmp)
{
  const auto version = in_program<int (*)(void *)>("lammps_version");
  const auto setting = in_program<int (*)(void *, const char *)>("lammps_extract_setting");
  if (!version || !setting) return "the program does not pass its version to plugins";
  const std::string found = name_of(version(lmp));
  // volatile, so that the string in the file is compared, which a test changes
  const char *const volatile built_for = LAMMPS_VERSION;
  const std::string expected = built_for;
  if (found != expected)
    return "it was compiled for LAMMPS " + expected + ", but this is LAMMPS " + found +
        "; compile it with the source of this LAMMPS";
  const int big = setting(lmp, "bigint"), tag = setting(lmp, "tagint"),
            image = setting(lmp, "imageint");
  if (big != sizeof(bigint) || tag != sizeof(tagint) || image != sizeof(imageint))
    return "it was compiled for " + sizes(sizeof(bigint), sizeof(tagint), sizeof(imageint)) +
        ", but this LAMMPS has " + sizes(big, tag, image) +
        "; compile it with the same LAMMPS_SIZES";
  return {};
}

/// Whether the program already has the styles, and not from this plugin.
bool compiled_in(LAMMPS *lmp)
{
  const auto found = lmp->force->pair_map->find("lsm/free");
  return found != lmp->force->pair_map->end() &&
      found->second != reinterpret_cast<Force::PairCreator>(&make<Pair, PairLSMFree>);
}

}    // namespace

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  std::string why = mismatch(lmp);
  if (why.empty() && compiled_in(static_cast<LAMMPS *>(lmp)))
    why = "the package is compiled into this LAMMPS already";
  if (!why.empty()) {
    int me = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    if (me == 0) {
      printf("WARNING: Plugin of the LSM package not loaded: %s\n", why.c_str());
      fflush(stdout);
    }
    return;
  }
  Registrar styles(lmp, handle, regfunc);
#define BOND_CLASS
#define BondStyle(name, Style) styles.add<Bond, Style>("bond", #name, "bond style " #name);
#define PAIR_CLASS
#define PairStyle(name, Style) styles.add<Pair, Style>("pair", #name, "pair style " #name);
#define FIX_CLASS
#define FixStyle(name, Style) styles.add<Fix, Style>("fix", #name, "fix style " #name);
#define COMPUTE_CLASS
#define ComputeStyle(name, Style) \
  styles.add<Compute, Style>("compute", #name, "compute style " #name);
#define COMMAND_CLASS
#define CommandStyle(name, Style) styles.add<Command, Style>("command", #name, "command " #name);
#include "lsm_styles.h"
}
