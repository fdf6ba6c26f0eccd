// SPDX-License-Identifier: GPL-2.0-or-later
// Coefficients of a force style in a restart file: the same list is used for writing and reading

#ifndef LMP_LSM_RESTART_FILE_H
#define LMP_LSM_RESTART_FILE_H

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "files/state.h"
#include "lsm_restart_version.h"
#include "pointers.h"

#include <cstdint>
#include <cstdio>
#include <mpi.h>

namespace LAMMPS_NS {

/// As in LAMMPS, only rank 0 writes, and rank 0 reads the file and sends what it reads to all
/// ranks.
class LSMRestartFile : public LSM::StateVisitor<LSMRestartFile>, protected Pointers {
 public:
  LSMRestartFile(LAMMPS *_lmp, FILE *file, bool reading) :
      Pointers(_lmp), reads(reading), file_(file)
  {
  }
  const bool reads;

  template <class Value> void one(Value &value)
  {
    auto number = static_cast<double>(value);
    if (!reads) {
      fwrite(&number, sizeof(number), 1, file_);
      return;
    }
    if (comm->me == 0) utils::sfread(FLERR, &number, sizeof(number), 1, file_, nullptr, error);
    MPI_Bcast(&number, 1, MPI_DOUBLE, 0, world);
    value = static_cast<Value>(number);
  }
  void expect(std::int64_t) {}

  /// Writes, or reads and checks, the version with which the data of each style begin.
  void version()
  {
    const int wanted = domain->dimension == 3 ? LSM_RESTART_VERSION_3D : LSM_RESTART_VERSION;
    int found = wanted;
    one(found);
    lsm_check_version(error, found, wanted);
  }

 private:
  FILE *const file_;
};

}    // namespace LAMMPS_NS

#endif
