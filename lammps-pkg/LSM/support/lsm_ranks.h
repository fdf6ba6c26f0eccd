// SPDX-License-Identifier: GPL-2.0-or-later
// What ranks tell each other

#ifndef LMP_LSM_RANKS_H
#define LMP_LSM_RANKS_H

#include <mpi.h>
#include <string>
#include <type_traits>
#include <vector>

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

/// All ranks get the values of rank 0, plain ones.
template <class Value> void lsm_share(std::vector<Value> &values, MPI_Comm world)
{
  static_assert(std::is_trivially_copy_constructible_v<Value>);
  int count = static_cast<int>(values.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, world);
  values.resize(count);
  MPI_Datatype type;    // more values can be sent than bytes
  MPI_Type_contiguous(sizeof(Value), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Bcast(values.data(), count, type, 0, world);
  MPI_Type_free(&type);
}

/// All ranks get the values of all, in the order of the ranks. type: that of a value
template <class Value>
std::vector<Value> lsm_gather(const std::vector<Value> &mine, MPI_Datatype type, MPI_Comm world)
{
  int ranks;
  MPI_Comm_size(world, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks), offsets(ranks, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 1; p < ranks; p++) offsets[p] = offsets[p - 1] + counts[p - 1];
  std::vector<Value> all(offsets.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type, world);
  return all;
}

}    // namespace LAMMPS_NS

#endif
