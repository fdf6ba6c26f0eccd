// SPDX-License-Identifier: GPL-2.0-or-later
// Lattice Solid Model: elastic link between two particles, Eq. (1)

#ifdef BOND_CLASS
// clang-format off
BondStyle(lsm/linked,BondLSMLinked);
// clang-format on
#else

#ifndef LMP_BOND_LSM_LINKED_H
#define LMP_BOND_LSM_LINKED_H

#include "bond.h"
#include "lsm_energy.h"

#include <functional>

namespace LAMMPS_NS {
namespace LSMLinkKernel {
  struct Windows;
}
namespace LSMLinkRows {
  struct Found;
}

class BondLSMLinked : public Bond, public LSMEnergySource {
 public:
  BondLSMLinked(class LAMMPS *);
  ~BondLSMLinked() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  // the rest length is a factor times r_i + r_j, but LAMMPS asks for a single number per type
  double equilibrium_distance(int type) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  double single(int, double, int, int, double &) override;
  void *extract(const char *, int &) override;

  /// Two particle IDs and the type of each link that broke since fix LSM_BREAK last collected them.
  std::vector<tagint> broken;

  struct CurrentLink {
    int i, j;    ///< local indices
    double stiffness, viscosity;
  };
  /// Passes on the links of the last force evaluation; under bond_style hybrid only those of this
  /// style.
  void for_each_current(const std::function<void(const CurrentLink &)> &) const;
  /// Largest strain |r - r0| / r0 of these links.
  double max_strain() const;
  bool is_viscous() const;    ///< by its coefficients
  /// Retardation times of the types, empty if all are 0.
  std::string retardation() const;

 private:
  // for each bond type

  std::vector<double> k;         // link stiffness
  std::vector<double> ratio;     // breaking distance over rest length; 0 if the link cannot break
  std::vector<double> factor;    // rest length over the sum of the radii
  std::vector<double> delay;     // retardation time: viscosity over stiffness; 0 if there is none
  double maxrad = 0.0;
  const bool avx2;    // the processor has AVX2
  struct Segment;
  std::vector<Segment> segments;    // links that are treated the same way
  // links of a segment that broke in this evaluation
  std::vector<LSMLinkRows::Found> broken_now;
  bigint collected_at = -1;    // step of the neighbour list that the links are from, -1 if outdated

  class FixLSMVelocity *velocity = nullptr;    // null if no link is viscous

  bool has_dashpot(int type) const;
  int stride(int type) const;
  void find_largest_radius();
  void allocate();
  void coefficients_in(class LSMRestartFile);
  std::vector<int> owned_by_id() const;
  void collect();
  template <int DIM> void eval();
  template <int DIM, class Law>
  double forces_of(const Segment &, LSMLinkKernel::Windows, const Law &);
  void note_broken(Segment &);
  template <class Act> void for_each_link(const Act &) const;
  void tally();
};

}    // namespace LAMMPS_NS

#endif
#endif
