/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Internal helper of pair style lsm/friction: contact history that a
   write_restart command between two runs leaves alone
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(LSM_HISTORY,FixLSMHistory);
// clang-format on
#else

#ifndef LMP_FIX_LSM_HISTORY_H
#define LMP_FIX_LSM_HISTORY_H

#include "fix_neigh_history.h"

namespace LAMMPS_NS {

class FixLSMHistory : public FixNeighHistory {
 public:
  FixLSMHistory(class LAMMPS *, int, char **);
  void init() override;
  void write_restart(FILE *) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
