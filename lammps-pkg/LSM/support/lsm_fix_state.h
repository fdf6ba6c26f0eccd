// SPDX-License-Identifier: GPL-2.0-or-later
// What a fix keeps in restart files, by its visit(): see files/state.h

#ifndef LMP_LSM_FIX_STATE_H
#define LMP_LSM_FIX_STATE_H

#include "comm.h"
#include "files/state.h"
#include "fix.h"
#include "lsm_ranks.h"
#include "lsm_restart_version.h"
#include "lsm_scene.h"

#include <cstdio>
#include <vector>

namespace LAMMPS_NS {

/// Adds sum(mine) for a number of which each rank has a part: the total is stored, and rank 0
/// continues with all of it.
class LSMStateWriter : public LSM::StateWriter {
 public:
  LSMStateWriter(std::vector<double> &to, MPI_Comm world) : StateWriter(to), world_(world) {}
  void sum(double mine) { one(lsm_total(mine, world_)); }

 private:
  MPI_Comm world_;
};

class LSMStateReader : public LSM::StateReader {
 public:
  LSMStateReader(const char *buf, bool first) :
      StateReader(reinterpret_cast<const double *>(buf)), first_(first)
  {
  }
  void sum(double &mine)
  {
    one(mine);
    if (!first_) mine = 0.0;
  }

 private:
  bool first_;
};

/// Base of a fix whose state in restart files consists of what its visit() lists.
template <class Self, class Base = Fix> class LSMKeptFix : public Base {
 public:
  LSMKeptFix(LAMMPS *_lmp, int narg, char **arg) : Base(_lmp, narg, arg)
  {
    this->restart_global = 1;
    LSMScene::set_up_next_run(_lmp);
  }
  ~LSMKeptFix() override
  {
    if (this->update) LSMScene::set_up_next_run(this->lmp);
  }
  void write_restart(FILE *fp) override
  {
    std::vector<double> numbers;
    LSMStateWriter to(numbers, this->world);
    to.one(LSM_RESTART_VERSION);
    Self::visit(static_cast<const Self &>(*this), to);
    if (this->comm->me) return;
    const int size = static_cast<int>(numbers.size() * sizeof(double));
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(numbers.data(), sizeof(double), numbers.size(), fp);
  }
  void restart(char *buf) override
  {
    LSMStateReader from(buf, this->comm->me == 0);
    double version;
    from.one(version);
    lsm_check_version(this->error, static_cast<int>(version));
    Self::visit(static_cast<Self &>(*this), from);
  }
  double compute_scalar() override { return lsm_total(*mine, this->world); }

 protected:
  /// Declares the output of the fix, at every step: a scalar, the total of `parts` over the ranks
  /// or what an overridden compute_scalar() returns, and a vector of intensive numbers.
  void has_output(const double *parts, int numbers = 0)
  {
    mine = parts;
    this->scalar_flag = this->global_freq = 1;
    this->extscalar = parts != nullptr;
    this->size_vector = numbers;
    this->vector_flag = numbers > 0;
    this->extvector = 0;
  }

 private:
  const double *mine = nullptr;
};

}    // namespace LAMMPS_NS

#endif
