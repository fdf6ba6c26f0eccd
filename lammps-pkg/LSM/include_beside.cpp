/* ----------------------------------------------------------------------
   SPDX-License-Identifier: GPL-2.0-or-later
------------------------------------------------------------------------- */

#include "include_beside.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "platform.h"

#include <cstring>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   The folder of the script is known only if it was given with -in; a script read from standard input
   looks in the current folder.
------------------------------------------------------------------------- */

void IncludeBeside::command(int narg, char **arg)
{
  if (narg != 1) error->all(FLERR, "include_beside expects one file name, but got {} words", narg);

  char path[4096] = "";
  int readable = 1;
  if (comm->me == 0) {
    std::string full = arg[0];
    if (infile && infile != stdin && !full.empty() && full.front() != '/') {
      char script[2048];
      const std::string name = platform::guesspath(infile, script, sizeof(script));
      const auto slash = name.find_last_of('/');
      if (slash != std::string::npos) full = name.substr(0, slash + 1) + full;
    }
    readable = full.size() < sizeof(path) && platform::file_is_readable(full);
    strncpy(path, full.c_str(), sizeof(path) - 1);
  }
  MPI_Bcast(path, sizeof(path), MPI_CHAR, 0, world);
  MPI_Bcast(&readable, 1, MPI_INT, 0, world);
  if (!readable) error->all(FLERR, "include_beside: cannot read file {}", path);
  input->one(std::string("include \"") + path + "\"");
}
