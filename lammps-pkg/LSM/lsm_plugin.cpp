// SPDX-License-Identifier: GPL-2.0-or-later
// Registers every style of the package with a LAMMPS that loads it by 'plugin load lsmplugin.so'.
// This file belongs to the plugin only: in a compiled-in package LAMMPS finds the styles itself.

#include "lammpsplugin.h"
#include "version.h"

#include "bond_lsm_linked.h"
#include "compute_lsm_events.h"
#include "create_lsm_fault.h"
#include "include_beside.h"
#include "fix_lsm_break.h"
#include "fix_lsm_history.h"
#include "fix_lsm_nve.h"
#include "fix_lsm_plates.h"
#include "fix_lsm_record.h"
#include "pair_lsm_free.h"
#include "pair_lsm_friction.h"

using namespace LAMMPS_NS;

namespace {

// The factories must return the base class: LAMMPS calls them through a pointer of that type.
template <class Base, class Style> Base *make(LAMMPS *lmp)
{
  return new Style(lmp);
}

template <class Base, class Style> Base *make_with_args(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}

class Registrar {
 public:
  Registrar(void *lmp, void *handle, void *regfunc) :
      lmp_(lmp), register_(reinterpret_cast<lammpsplugin_regfunc>(regfunc))
  {
    plugin_.version = LAMMPS_VERSION;
    plugin_.author = "the LSM package";
    plugin_.handle = handle;
  }

  template <class Base, class Style>
  void add(const char *category, const char *name, const char *info)
  {
    plugin_.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(&make<Base, Style>);
    enter(category, name, info);
  }

  template <class Base, class Style>
  void add_with_args(const char *category, const char *name, const char *info)
  {
    plugin_.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(&make_with_args<Base, Style>);
    enter(category, name, info);
  }

 private:
  void enter(const char *category, const char *name, const char *info)
  {
    plugin_.style = category;
    plugin_.name = name;
    plugin_.info = info;
    (*register_)(&plugin_, lmp_);
  }

  void *lmp_;
  lammpsplugin_regfunc register_;
  lammpsplugin_t plugin_{};
};

}    // namespace

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  Registrar styles(lmp, handle, regfunc);
  styles.add<Bond, BondLSMLinked>("bond", "lsm/linked", "bond style lsm/linked");
  styles.add<Pair, PairLSMFree>("pair", "lsm/free", "pair style lsm/free");
  styles.add<Pair, PairLSMFriction>("pair", "lsm/friction", "pair style lsm/friction");
  styles.add_with_args<Fix, FixLSMNVE>("fix", "lsm/nve", "fix style lsm/nve");
  styles.add_with_args<Fix, FixLSMPlates>("fix", "lsm/plates", "fix style lsm/plates");
  // Created by the other styles for their own use.
  styles.add_with_args<Fix, FixLSMRecord>("fix", "LSM_RECORD", "fix style LSM_RECORD");
  styles.add_with_args<Fix, FixLSMHistory>("fix", "LSM_HISTORY", "fix style LSM_HISTORY");
  styles.add_with_args<Fix, FixLSMBreak>("fix", "LSM_BREAK", "fix style LSM_BREAK");
  styles.add_with_args<Compute, ComputeLSMEvents>("compute", "lsm/events",
                                                  "compute style lsm/events");
  styles.add<Command, CreateLSMFault>("command", "create_lsm_fault", "command create_lsm_fault");
  styles.add<Command, IncludeBeside>("command", "include_beside", "command include_beside");
}
