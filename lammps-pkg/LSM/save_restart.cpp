// SPDX-License-Identifier: GPL-2.0-or-later

#include "save_restart.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "update.h"
#include "variable.h"
#include "write_restart.h"

#include "lsm_ranks.h"
#include "lsm_restart_info.h"

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace LAMMPS_NS;

// LAMMPS ends a restart file with this, and does not check that it reached the disk
static bool ends_well(const std::string &file)
{
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(in.tellg());
  in.seekg(size > 64 ? size - 64 : 0);
  const std::string end((std::istreambuf_iterator<char>(in)), {});
  return end.find("RestartT") != std::string::npos;
}

namespace {
/// Removes a file that was not renamed.
struct Draft {
  std::string file;
  bool mine;
  ~Draft()
  {
    std::error_code code;
    if (mine) std::filesystem::remove(file, code);
  }
};
}    // namespace

void SaveRestart::command(int narg, char **arg)
{
  if (narg < 1) error->all(FLERR, "save_restart expects a file name and names of variables");
  const std::string file = arg[0];
  LSM::text_io::Parameters settings;
  for (int n = 1; n < narg; n++) {
    const char *const value = input->variable->retrieve(arg[n]);
    if (!value) error->all(FLERR, "save_restart: there is no variable {}", arg[n]);
    if (std::string(value).find('\n') != std::string::npos)
      error->all(FLERR, "save_restart: the value of variable {} has more than one line", arg[n]);
    settings.emplace_back(arg[n], value);
  }
  save(file, settings, false);
}

void SaveRestart::save(const std::string &file, const LSM::text_io::Parameters &settings,
                       bool within_run)
{
  if (file.empty() || file.find_first_of("*%") != std::string::npos)
    error->all(FLERR, "save_restart expects the name of one file, without * and %, but got '{}'",
               file);
  Draft draft{file + ".new", comm->me == 0};
  WriteRestart writer(lmp);
  if (within_run) {
    writer.multiproc_options(0, 0, nullptr);
    writer.write(draft.file);
  } else {
    char *words[] = {draft.file.data()};
    writer.command(1, words);
  }

  const std::string problem = lsm_on_0(world, [&] {
    LSM::text_io::Parameters all = {{"step", std::to_string(update->ntimestep)},
                                    {"ranks", std::to_string(comm->nprocs)}};
    all.insert(all.end(), settings.begin(), settings.end());
    if (!ends_well(draft.file)) throw LSM::FileError("the file on disk is incomplete");
    LSM::seal_restart(draft.file, file, all);
  });
  if (!problem.empty())
    error->all(FLERR, "save_restart: cannot write restart file {}: {}", file, problem);
}
