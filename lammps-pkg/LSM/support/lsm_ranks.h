// SPDX-License-Identifier: GPL-2.0-or-later
// Communication between ranks

#ifndef LMP_LSM_RANKS_H
#define LMP_LSM_RANKS_H

#include <cstdint>
#include <exception>
#include <mpi.h>
#include <string>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

/// The MPI type of a C++ type.
template <class Value> MPI_Datatype lsm_mpi_type()
{
  if constexpr (std::is_same_v<Value, double>) return MPI_DOUBLE;
  if constexpr (std::is_same_v<Value, int>) return MPI_INT;
  if constexpr (std::is_same_v<Value, char>) return MPI_CHAR;
  if constexpr (std::is_same_v<Value, std::int64_t>) return MPI_INT64_T;
  if constexpr (std::is_same_v<Value, std::uint64_t>) return MPI_UINT64_T;
}

template <class Value> Value lsm_reduce(Value mine, MPI_Op operation, MPI_Comm world)
{
  Value all{};
  MPI_Allreduce(&mine, &all, 1, lsm_mpi_type<Value>(), operation, world);
  return all;
}

template <class Value> Value lsm_total(Value mine, MPI_Comm world)
{
  return lsm_reduce(mine, MPI_SUM, world);
}

template <class Value> Value lsm_largest(Value mine, MPI_Comm world)
{
  return lsm_reduce(mine, MPI_MAX, world);
}

/// Sends the text of rank 0 to all ranks.
inline void lsm_share(std::string &text, MPI_Comm world)
{
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  text.resize(length);
  if (length) MPI_Bcast(&text[0], length, MPI_CHAR, 0, world);
}

/// Performs a task on rank 0. All ranks get its error message, or "".
template <class Task> std::string lsm_on_0(MPI_Comm world, Task &&task)
{
  int me;
  MPI_Comm_rank(world, &me);
  std::string problem;
  try {
    if (me == 0) task();
  } catch (std::exception &e) {
    problem = e.what();
  }
  lsm_share(problem, world);
  return problem;
}

/// Sends the values of rank 0, of a trivially copyable type, to all ranks.
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

/// Gathers the values of all ranks on rank 0, in the order of the ranks.
template <class Value>
std::vector<Value> lsm_gather_on_0(const std::vector<Value> &mine, MPI_Comm world)
{
  int me, ranks;
  MPI_Comm_rank(world, &me);
  MPI_Comm_size(world, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks, 0), offsets(ranks, 0);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  for (int p = 1; p < ranks; p++) offsets[p] = offsets[p - 1] + counts[p - 1];
  std::vector<Value> all(me == 0 ? offsets.back() + counts.back() : 0);
  const MPI_Datatype type = lsm_mpi_type<Value>();
  MPI_Gatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type, 0, world);
  return all;
}

/// Gathers the values of all ranks on all ranks.
template <class Value> std::vector<Value> lsm_gather(const std::vector<Value> &mine, MPI_Comm world)
{
  std::vector<Value> all = lsm_gather_on_0(mine, world);
  lsm_share(all, world);
  return all;
}

}    // namespace LAMMPS_NS

#endif
