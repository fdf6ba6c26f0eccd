/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Lattice Solid Model: elastic link between two particles, Eq. (1)
------------------------------------------------------------------------- */

#ifdef BOND_CLASS
// clang-format off
BondStyle(lsm/linked,BondLSMLinked);
// clang-format on
#else

#ifndef LMP_BOND_LSM_LINKED_H
#define LMP_BOND_LSM_LINKED_H

#include "bond.h"
#include "lsm_energy.h"

#include <vector>

namespace LAMMPS_NS {

class BondLSMLinked : public Bond, public LSMEnergySource {
 public:
  BondLSMLinked(class LAMMPS *);
  ~BondLSMLinked() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double equilibrium_distance(int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  double single(int, double, int, int, double &) override;
  void *extract(const char *, int &) override;

  /// Pairs of particle IDs whose link broke since fix LSM_BREAK last took them.
  std::vector<tagint> broken;
  /// Largest |r - r0| / r0 of the links this rank holds.
  double max_strain() const;

 protected:
  double *k;        // link stiffness of each bond type
  double *ratio;    // breaking distance over rest length; 0 if the link cannot break
  int breakable;    // 1 if any type of link can break
  double maxrad;

  void allocate();

 private:
  template <bool EV, bool RECORD, bool BREAK, bool DIM3> void eval();
};

}    // namespace LAMMPS_NS

#endif
#endif
