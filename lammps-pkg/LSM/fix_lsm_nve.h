/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Velocity Verlet for the Lattice Solid Model with optional viscosity
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(lsm/nve,FixLSMNVE);
// clang-format on
#else

#ifndef LMP_FIX_LSM_NVE_H
#define LMP_FIX_LSM_NVE_H

#include "fix.h"

#include <vector>

namespace LAMMPS_NS {

class FixLSMNVE : public Fix {
 public:
  FixLSMNVE(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void reset_dt() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  bool record_work;        // set by compute lsm/events when it keeps the energy ledger
  double work_viscosity;    // work lost to viscosity, this rank, accumulated
  double viscosity() const { return nu; }

 private:
  enum { ERROR, WARN, OFF };
  double nu;            // force -nu m v
  double dtv, dtf;
  double decay;         // factor of the velocities in half a step of viscosity
  int check;            // what to do when the time step is above the stability limit
  double omega;         // highest frequency found at setup
  double dt_limit;      // 2/omega
  std::vector<double> trial, image;    // vectors of the power iteration, 2 or 3 values an atom

  template <bool FIRST, bool VISCOUS, bool WORK, bool DIM3> void half_step();
  void (FixLSMNVE::*initial_chosen)();
  void (FixLSMNVE::*final_chosen)();
  template <bool DIM3> void choose();
  double highest_frequency();
};

}    // namespace LAMMPS_NS

#endif
#endif
