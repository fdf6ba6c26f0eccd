// SPDX-License-Identifier: GPL-2.0-or-later
// Energies that the LSM force styles record at every force evaluation,
// without LAMMPS' energy and virial machinery, when a compute asks for them.

#ifndef LMP_LSM_ENERGY_H
#define LMP_LSM_ENERGY_H

#include "events/slip_recorder.h"

#include <vector>

namespace LAMMPS_NS {

/// Base of the force styles whose energies compute lsm/events records.
/// All values are this rank's share; a pair shared by two ranks counts half on each.
class LSMEnergySource {
 public:
  enum { NONE = 0, ENERGY = 1, SLIP_RATE = 2, CONTACTS = 4 };

  virtual ~LSMEnergySource() noexcept(false) {}    // as LAMMPS' own base classes

  int record_what = NONE;        ///< what to record, for those who asked until they go
  double pe_link = 0.0;          ///< link springs, at the last force evaluation
  double pe_contact = 0.0;       ///< normal contact springs, at the last force evaluation
  double pe_tangential = 0.0;    ///< tangential contact springs, at the last force evaluation
  double work_friction = 0.0;    ///< work lost to friction, accumulated
  double work_broken = 0.0;      ///< energy of the links that broke, accumulated
  double slip_moment = 0.0;      ///< sum of |slip| times contact size, accumulated (SLIP_RATE)

  /// Bits of the groups on the two sides of the fault, for CONTACTS.
  int lower_side = 0, upper_side = 0;
  double work_within = 0.0;    ///< part of work_friction that is lost elsewhere, accumulated
  /// all contacts across the fault in the last force evaluation, with friction
  std::vector<LSM::FaultContact> contacts;

  void record_nothing()
  {
    record_what = NONE;
    lower_side = upper_side = 0;
  }
  /// Returns 1 for a contact of a first particle on the upper side with a second one on the lower
  /// side, -1 the other way round, and 0 if both are on the same side or one is on neither.
  int across_fault(int mask_i, int mask_j) const
  {
    if ((mask_i & upper_side) && (mask_j & lower_side)) return 1;
    if ((mask_i & lower_side) && (mask_j & upper_side)) return -1;
    return 0;
  }
};

/// Base of the fixes that do work on particles, other than by plates. Works are this rank's share
/// and continue after a restart.
class LSMWorkSource {
 public:
  virtual ~LSMWorkSource() noexcept(false) {}

  double work_outside = 0.0;     ///< done on the particles by given forces, accumulated
  double work_absorbed = 0.0;    ///< lost to dashpots at borders, accumulated
  double work_dashpots = 0.0;    ///< lost to those of links and contacts, accumulated
};

/// Base of the fixes that give contacts radii of their own.
class LSMContactRadii {
 public:
  virtual ~LSMContactRadii() noexcept(false) {}

  virtual const double *
  contact_radii() const = 0;    ///< of the particles of this rank and its ghosts
};

}    // namespace LAMMPS_NS

#endif
