// SPDX-License-Identifier: GPL-2.0-or-later

#include "include_beside.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "lsm_ranks.h"
#include "platform.h"

#include <string>

using namespace LAMMPS_NS;

// The folder of the script is known only if it was given with -in; a script read from standard input
// looks in the current folder.
void IncludeBeside::command(int narg, char **arg)
{
  if (narg != 1) error->all(FLERR, "include_beside expects one file name, but got {} words", narg);

  std::string path = arg[0];
  if (comm->me == 0 && infile && infile != stdin && !path.empty() && path.front() != '/') {
    char script[2048];
    const std::string name = platform::guesspath(infile, script, sizeof(script));
    const auto slash = name.find_last_of('/');
    if (slash != std::string::npos) path = name.substr(0, slash + 1) + path;
  }
  lsm_share(path, world);
  int readable = comm->me == 0 && platform::file_is_readable(path);
  MPI_Bcast(&readable, 1, MPI_INT, 0, world);
  if (!readable) error->all(FLERR, "include_beside: cannot read file {}", path);
  input->one("include \"" + path + "\"");
}
