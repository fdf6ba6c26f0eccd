// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_block_gather.h"

using namespace LAMMPS_NS;

LSMBlockGather::LSMBlockGather(MPI_Comm world) : world_(world), me_(0)
{
  MPI_Comm_rank(world_, &me_);
  MPI_Comm_size(world_, &block_.ranks);
}

LSMBlockGather::~LSMBlockGather()
{
  // after an error between two steps a block may still be in transit, on all ranks
  if (pending_) MPI_Wait(&request_, MPI_STATUS_IGNORE);
}

void LSMBlockGather::start(const LSM::SampleBlock &mine)
{
  block_.first = mine.first;
  block_.count = mine.count;
  const size_t all = static_cast<size_t>(block_.ranks) * mine.count;
  if (me_ == 0 && block_.pe.size() < all) block_.pe.resize(all);
  MPI_Igather(mine.pe.data(), mine.count, MPI_DOUBLE, block_.pe.data(), mine.count, MPI_DOUBLE, 0,
              world_, &request_);
  pending_ = true;

  const auto sum = [this](const std::vector<double> &of, std::vector<double> &sums) {
    sums.resize(me_ == 0 ? of.size() : 0);
    if (!of.empty())
      MPI_Reduce(of.data(), sums.data(), static_cast<int>(of.size()), MPI_DOUBLE, MPI_SUM, 0,
                 world_);
  };
  sum(mine.friction, block_.friction);

  // the intervals end at the same steps on all ranks
  sum(mine.intervals, block_.intervals);
}

bool LSMBlockGather::finish()
{
  if (!pending_) return false;
  MPI_Wait(&request_, MPI_STATUS_IGNORE);
  pending_ = false;
  return true;
}
