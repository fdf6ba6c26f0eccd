// SPDX-License-Identifier: GPL-2.0-or-later
// Coefficients of a force style in a restart file: one list of them writes and reads

#ifndef LMP_LSM_RESTART_FILE_H
#define LMP_LSM_RESTART_FILE_H

#include "comm.h"
#include "pointers.h"

#include <cstdio>
#include <mpi.h>

namespace LAMMPS_NS {

/// As LAMMPS has it, rank 0 alone writes, and all ranks read, of which rank 0 has the file.
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

  /// Whether something follows that most files do not have: behind a mark, with which nothing else begins.
  /// \param written  it is to be written
  template <class Value> bool follows(Value mark, bool written)
  {
    if (!reads) {
      if (written) (*this)(&mark);
      return written;
    }
    Value found{};
    (*this)(&found);
    if (found != mark && comm->me == 0) fseek(file_, -static_cast<long>(sizeof(Value)), SEEK_CUR);
    return found == mark;
  }

 private:
  FILE *const file_;
};

}    // namespace LAMMPS_NS

#endif
