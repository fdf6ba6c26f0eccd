// SPDX-License-Identifier: GPL-2.0-or-later
// Coefficients of a force style in a restart file: the same list is used for writing and reading

#ifndef LMP_LSM_RESTART_FILE_H
#define LMP_LSM_RESTART_FILE_H

#include "comm.h"
#include "error.h"
#include "lsm_restart_version.h"
#include "pointers.h"

#include <cstdio>
#include <mpi.h>
#include <string>

namespace LAMMPS_NS {

/// As in LAMMPS, only rank 0 writes, and rank 0 reads the file and sends what it reads to all
/// ranks.
class LSMRestartFile : protected Pointers {
 public:
  LSMRestartFile(LAMMPS *_lmp, FILE *file, bool reading) :
      Pointers(_lmp), reads(reading), file_(file)
  {
  }
  const bool reads;

  template <class Value> void operator()(Value *values, int count = 1)
  {
    if (!reads) {
      fwrite(values, sizeof(Value), count, file_);
      return;
    }
    if (comm->me == 0) utils::sfread(FLERR, values, sizeof(Value), count, file_, nullptr, error);
    MPI_Bcast(values, static_cast<int>(count * sizeof(Value)), MPI_BYTE, 0, world);
  }

  /// Writes, or reads and checks, the version with which the data of each style begin.
  void version()
  {
    int found = LSM_RESTART_VERSION;
    (*this)(&found);
    lsm_check_version(error, found);
  }

  /// Writes or reads a text, which follows its length.
  void operator()(std::string &text)
  {
    int size = static_cast<int>(text.size());
    (*this)(&size);
    text.resize(size);
    if (size) (*this)(text.data(), size);
  }

 private:
  FILE *const file_;
};

}    // namespace LAMMPS_NS

#endif
