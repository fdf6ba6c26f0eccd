// SPDX-License-Identifier: GPL-2.0-or-later

#include "check_restart.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "variable.h"

#include "lsm_ranks.h"
#include "lsm_restart_info.h"

#include <cstring>

using namespace LAMMPS_NS;

// check_restart FILE [free NAME ...] [fixed NAME ...]
void CheckRestart::command(int narg, char **arg)
{
  if (narg < 1) error->all(FLERR, "check_restart expects a file name");
  const std::string file = arg[0];

  LSM::text_io::Parameters settings;    // on rank 0
  const std::string problem =
      lsm_on_0(world, [&file, &settings] { settings = LSM::check_restart(file); });
  if (!problem.empty()) error->all(FLERR, "check_restart: {}", problem);

  const char *keyword = nullptr;
  for (int n = 1; n < narg; n++) {
    if (strcmp(arg[n], "fixed") == 0 || strcmp(arg[n], "free") == 0) {
      keyword = arg[n];
      continue;
    }
    if (!keyword)
      error->all(FLERR, "check_restart expects the keyword fixed or free before '{}'", arg[n]);
    const std::string *const value = LSM::text_io::find(settings, arg[n]);
    int found = value ? 1 : 0;
    MPI_Bcast(&found, 1, MPI_INT, 0, world);
    std::string text = value ? *value : "";
    lsm_share(text, world);
    take(file, arg[n], found ? &text : nullptr, keyword[1] == 'i');
  }
}

// a variable that is there was set on the command line, or by a script that includes this one
void CheckRestart::take(const std::string &file, const std::string &name, const std::string *value,
                        bool fixed)
{
  if (!value) {
    if (fixed && comm->me == 0)
      error->warning(FLERR, "Restart file {} has no value of {}: the given one is used", file,
                     name);
    return;
  }
  const char *const given = input->variable->retrieve(name.c_str());
  if (given && *value != given) {
    double a, b;
    const bool same = LSM::text_io::parse(*value, a) && LSM::text_io::parse(given, b) && a == b;
    if (fixed && !same)
      error->all(FLERR,
                 "Variable {} is {}, but restart file {} was written with {} = {}, which it "
                 "cannot change; leave it out",
                 name, given, file, name, *value);
    if (!same) return;

    // the same number, written differently: as before, for the headers of continued files
    input->variable->set(name + " delete");
  }
  if (input->variable->retrieve(name.c_str())) return;
  std::string index = name, text = *value;
  char *values[] = {text.data()};
  input->variable->set(index.data(), 1, values);
}
