/* -*- c++ -*- ----------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
   Forces and energy of a list of links, Eq. (1), with the widest vectors
   of the machine and the same digits on each
------------------------------------------------------------------------- */

#ifndef LMP_LSM_LINK_KERNEL_H
#define LMP_LSM_LINK_KERNEL_H

#include <vector>

namespace LAMMPS_NS {
namespace LSMLinkKernel {

  constexpr int BLOCK = 256;    ///< links whose energies are added before they go to the total

  /// The two particles of a link: 3 times their local index.
  struct Ends {
    int i, j;
  };

  /// Links that are treated the same way.
  struct Links {
    const Ends *ends;
    const double *rest;    ///< rest lengths
    int count;
    double stiffness;
    double ratio;                 ///< breaking distance over rest length, only used in BREAK
    bool first_only;              ///< no force on the second particle: its owner adds it
    const int *to_fetch;          ///< places (as in Ends) to fetch into the cache, block by block
    const int *to_fetch_begin;    ///< where those of each block begin, and of the last end
  };

  /// Adds the forces of the links to f and returns their elastic energy. In BREAK, links that are longer than
  /// their breaking distance give neither, and their numbers are added to `broken`.
  template <int DIM, bool BREAK>
  double forces(const Links &, const double *x, double *f, std::vector<int> &broken);

}    // namespace LSMLinkKernel
}    // namespace LAMMPS_NS

#endif
