// SPDX-License-Identifier: GPL-2.0-or-later
// What the loop over contacts with friction calls

#ifndef LMP_LSM_FRICTION_HOST_H
#define LMP_LSM_FRICTION_HOST_H

#include "friction/friction_contact.h"
#include "lsm_contacts.h"

namespace LAMMPS_NS {
namespace LSMFriction {
  namespace friction = LSM::friction_contact;

  /// What the loop leaves to LAMMPS, as few scenes need it.
  class Host {
   public:
    virtual ~Host() noexcept(false) {}    // as LAMMPS' own base classes

    /// Tallies LAMMPS' own energy and virial, from the force on the first particle and the vector
    /// to it from the second. Called only by a recorder that tallies.
    virtual void tally(const LSMContacts::Pair &, double energy, const friction::Vector &force,
                       const friction::Vector &del) = 0;
  };

}    // namespace LSMFriction
}    // namespace LAMMPS_NS

#endif
