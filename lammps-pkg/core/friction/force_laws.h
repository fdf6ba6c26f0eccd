// SPDX-License-Identifier: GPL-2.0-or-later
/// \file friction/force_laws.h
/// Force laws of the Lattice Solid Model (Weatherley & Abe 2004, Eqs. 1 to 3), independent of any
/// program, and what all contacts share. Lengths, energies and stiffnesses are in model units.
#ifndef LSM_FORCE_LAWS_H
#define LSM_FORCE_LAWS_H

#include "friction/coulomb.h"
#include "friction/linear_spring.h"

namespace LSM {

/// Fraction of a step during which a new contact existed, if the distance fell linearly from
/// r_before >= r0 to r < r0. The tangential spring takes this fraction of the step's displacement.
inline double share_in_contact(double r_before, double r, double r0) {
  return r_before > r ? (r0 - r) / (r_before - r) : 0.0;
}

/// Effective size of a contact for the slip moment (*): twice the reduced radius.
inline double contact_size(double ri, double rj) { return 2.0 * ri * rj / (ri + rj); }

}  // namespace LSM

#endif
