/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Lattice Solid Model: repulsion and Coulomb friction of unlinked
   particles, Eqs. (2) and (3), two dimensions
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(lsm/friction,PairLSMFriction);
// clang-format on
#else

#ifndef LMP_PAIR_LSM_FRICTION_H
#define LMP_PAIR_LSM_FRICTION_H

#include "pair_lsm_free.h"

namespace LAMMPS_NS {

class PairLSMFriction : public PairLSMFree {
 public:
  PairLSMFriction(class LAMMPS *);
  ~PairLSMFriction() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  void transfer_history(double *, double *, int, int) override;

 protected:
  double **kt, **mu, **mus;    // tangential stiffness, dynamic and static friction coefficient
  int **own_static;            // 1 if mus was given, else it follows mu
  int has_static;              // 1 if any mus > mu
  int locate_onset;            // 1 if the begin of a contact within a step is located
  class FixDummy *fix_dummy;
  class FixNeighHistory *fix_history;

  void allocate() override;
  int request_flags() const override;
  void write_coeff(FILE *, int, int) override;
  void read_coeff(FILE *, int, int) override;
  void print_coeff(FILE *, int, int) override;

 private:
  template <bool LOCATE> void choose(int);
  template <bool EV, bool RECORD, bool HAS_STATIC, bool LOCATE> void eval();
};

}    // namespace LAMMPS_NS

#endif
#endif
