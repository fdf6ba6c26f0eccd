// SPDX-License-Identifier: GPL-2.0-or-later
// What ranks tell each other

#ifndef LMP_LSM_RANKS_H
#define LMP_LSM_RANKS_H

#include <mpi.h>
#include <string>

namespace LAMMPS_NS {

inline double lsm_total(double mine, MPI_Comm world)
{
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/// All ranks get the text of rank 0.
inline void lsm_share(std::string &text, MPI_Comm world)
{
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  text.resize(length);
  if (length) MPI_Bcast(&text[0], length, MPI_CHAR, 0, world);
}

}    // namespace LAMMPS_NS

#endif
