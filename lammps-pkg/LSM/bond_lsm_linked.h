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
#include "lsm_link_kernel.h"

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

  /// Two particle IDs and the type of each link that broke since fix LSM_BREAK last took them.
  std::vector<tagint> broken;

  struct Held {
    int i, j;    ///< local indices
    double stiffness;
  };
  /// Links of the last force evaluation, those of this style only under bond_style hybrid.
  std::vector<Held> held() const;
  /// Largest |r - r0| / r0 among them.
  double max_strain() const;

 protected:
  double *k;        // link stiffness of each bond type
  double *ratio;    // breaking distance over rest length; 0 if the link cannot break
  int breakable;    // 1 if any type of link can break
  double maxrad;

  void allocate();

 private:
  struct Segment {    // links that are treated the same way
    int first, last;
    int type;
    bool first_only;    // the force on the second particle is added by its owner
  };
  std::vector<LSMLinkKernel::Ends> ends;    // the links in the order of the sums
  std::vector<double> rest;                 // their rest lengths
  std::vector<Segment> segments;
  std::vector<int> to_fetch;          // places to fetch into the cache, block by block
  std::vector<int> to_fetch_begin;    // where those of each block begin
  std::vector<int>
      broken_now;         // links that broke in this evaluation, by their place in a segment
  bigint collected_at;    // step of the neighbour list they were taken from, -1 if outdated

  void collect();
  void list_to_fetch();
  template <int DIM> void eval();
  void note_broken(const Segment &);
  void tally();
};

}    // namespace LAMMPS_NS

#endif
#endif
