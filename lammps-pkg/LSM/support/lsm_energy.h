// SPDX-License-Identifier: GPL-2.0-or-later
// Energies that the LSM force styles record at every force evaluation,
// without LAMMPS' energy and virial machinery, when a compute asks for them.

#ifndef LMP_LSM_ENERGY_H
#define LMP_LSM_ENERGY_H

#include "lsm_slip_recorder.h"

#include <vector>

namespace LAMMPS_NS {

/// Base of the force styles whose energies compute lsm/events records.
/// All values are this rank's share; a pair shared by two ranks counts half on each.
class LSMEnergySource {
 public:
  enum { NONE = 0, ENERGY = 1, SLIP = 2, SLIP_RATE = 4, CONTACTS = 8 };

  virtual ~LSMEnergySource() noexcept(false) {}    // as LAMMPS' own base classes

  int record_what = NONE;        ///< what to record; the style resets it at every init
  double pe_link = 0.0;          ///< link springs, at the last force evaluation
  double pe_contact = 0.0;       ///< normal contact springs, at the last force evaluation
  double pe_tangential = 0.0;    ///< tangential contact springs, at the last force evaluation
  double work_friction = 0.0;    ///< work lost to friction, accumulated
  double work_broken = 0.0;      ///< energy of the links that broke, accumulated
  double slip_moment = 0.0;      ///< sum of |slip| times contact size, accumulated (SLIP_RATE)
  std::vector<LSM::ContactSlip> slip;    ///< contacts that slid in the last force evaluation
  /// all contacts of the last force evaluation, with friction
  std::vector<LSM::FaultContact> contacts;
};

/// Base of the fixes that do work on particles, other than by plates. This rank's share; a restart goes on with it.
class LSMWorkSource {
 public:
  virtual ~LSMWorkSource() noexcept(false) {}

  double work_outside = 0.0;     ///< done on the particles by given forces, accumulated
  double work_absorbed = 0.0;    ///< lost to dashpots at borders, accumulated
  double work_dashpots = 0.0;    ///< lost to those of links and contacts, accumulated
};

}    // namespace LAMMPS_NS

#endif
