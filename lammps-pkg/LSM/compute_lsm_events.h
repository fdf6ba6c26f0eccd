// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: potential energy at every step, slip events picked from its drops, ruptures
// and slip of the fault, energy ledger. Fix LSM_RECORD records them; this class asks it.

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(lsm/events,ComputeLSMEvents);
// clang-format on
#else

#ifndef LMP_COMPUTE_LSM_EVENTS_H
#define LMP_COMPUTE_LSM_EVENTS_H

#include "compute.h"

#include <string>

namespace LAMMPS_NS {

class ComputeLSMEvents : public Compute {
 public:
  ComputeLSMEvents(class LAMMPS *, int, char **);
  ~ComputeLSMEvents() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  std::string id_of_fix() const { return std::string(id) + "_record"; }
  class FixLSMRecord &recorder() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
