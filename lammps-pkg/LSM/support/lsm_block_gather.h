// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks of samples of all ranks on rank 0. Their energies travel while
// the ranks go on.

#ifndef LMP_LSM_BLOCK_GATHER_H
#define LMP_LSM_BLOCK_GATHER_H

#include "events/block_sampler.h"

#include <mpi.h>
#include <vector>

namespace LAMMPS_NS {

class LSMBlockGather {
 public:
  /// slip: the blocks hold slips
  LSMBlockGather(MPI_Comm, bool slip);
  ~LSMBlockGather();
  LSMBlockGather(const LSMBlockGather &) = delete;
  LSMBlockGather &operator=(const LSMBlockGather &) = delete;

  /// Sends a block, which must not change until finish().
  void start(const LSM::SampleBlock &);
  /// Waits for what was sent last; false if there is nothing. On rank 0 the block is complete then.
  bool finish();
  const LSM::GatheredBlock &block() const { return block_; }

 private:
  MPI_Comm world_;
  int me_;
  bool slip_;
  LSM::GatheredBlock block_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  bool pending_ = false;
};

}    // namespace LAMMPS_NS

#endif
