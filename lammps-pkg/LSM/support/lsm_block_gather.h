// SPDX-License-Identifier: GPL-2.0-or-later
// Gathers blocks of samples of all ranks on rank 0. Their energies are sent while the ranks
// continue.

#ifndef LMP_LSM_BLOCK_GATHER_H
#define LMP_LSM_BLOCK_GATHER_H

#include "events/block_sampler.h"

#include <mpi.h>
#include <vector>

namespace LAMMPS_NS {

class LSMBlockGather {
 public:
  explicit LSMBlockGather(MPI_Comm);
  ~LSMBlockGather();
  LSMBlockGather(const LSMBlockGather &) = delete;
  LSMBlockGather &operator=(const LSMBlockGather &) = delete;

  /// Sends a block, which must not change until finish().
  void start(const LSM::SampleBlock &);
  /// Waits until the last block has been sent, after which rank 0 has all of it. Returns false if
  /// there is none.
  bool finish();
  const LSM::GatheredBlock &block() const { return block_; }

 private:
  MPI_Comm world_;
  int me_;
  LSM::GatheredBlock block_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  bool pending_ = false;
};

}    // namespace LAMMPS_NS

#endif
