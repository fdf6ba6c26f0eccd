// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_script.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "platform.h"
#include "update.h"
#include "variable.h"
#include "write_restart.h"

#include "files/file_error.h"
#include "files/restart_info.h"
#include "lsm_ranks.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

using namespace LAMMPS_NS;

std::string LSMScript::beside(LAMMPS *lmp, FILE *script, const std::string &name,
                              const std::string &who)
{
  std::string path = name;
  if (lmp->comm->me == 0 && script && script != stdin && !path.empty() && path.front() != '/') {
    char buffer[2048];
    const std::string its_name = platform::guesspath(script, buffer, sizeof(buffer));
    const auto slash = its_name.find_last_of('/');
    if (slash != std::string::npos) path = its_name.substr(0, slash + 1) + path;
  }
  lsm_share(path, lmp->world);
  int readable = lmp->comm->me == 0 && platform::file_is_readable(path) &&
      !std::filesystem::is_directory(path);
  int from_input = script == stdin;
  MPI_Bcast(&readable, 1, MPI_INT, 0, lmp->world);
  MPI_Bcast(&from_input, 1, MPI_INT, 0, lmp->world);
  if (!readable)
    lmp->error->all(FLERR, "{}: cannot read file {}{}", who, path,
                    from_input ? "; the folder of a scene on standard input is not known, use "
                                 "'lmp -in FILE' instead of 'lmp < FILE'"
                               : "");
  return path;
}

void LSMScript::require_plain(LAMMPS *lmp, const std::string &who, const std::string &name)
{
  if (name.find_first_of("*%") != std::string::npos)
    lmp->error->all(FLERR, "{} is {}, but must be the name of a file without * and %", who, name);
}

LSM::files::Parameters LSMScript::listed(LAMMPS *lmp, const char *list)
{
  LSM::files::Parameters all;
  const char *const names = lmp->input->variable->retrieve(list);
  std::istringstream in(names ? names : "");
  for (std::string name; in >> name;) all.emplace_back(name, value_of(lmp, name, list));
  return all;
}

std::string LSMScript::value_of(LAMMPS *lmp, const std::string &name, const std::string &who)
{
  const char *const value = lmp->input->variable->retrieve(name.c_str());
  if (!value) lmp->error->all(FLERR, "{}: there is no variable {}", who, name);
  const std::string text = value;
  if (text.find('\n') != std::string::npos)
    lmp->error->all(FLERR, "{}: the value of variable {} has more than one line", who, name);
  return text;
}

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

void LSMScript::save_restart(LAMMPS *lmp, const std::string &file,
                             const LSM::files::Parameters &settings, bool within_run)
{
  Draft draft{file + ".new", lmp->comm->me == 0};
  WriteRestart writer(lmp);
  if (within_run) {
    writer.multiproc_options(0, 0, nullptr);
    writer.write(draft.file);
  } else {
    char *words[] = {draft.file.data()};
    writer.command(1, words);
  }

  const std::string problem = lsm_on_0(lmp->world, [&] {
    LSM::files::Parameters all = {{"step", std::to_string(lmp->update->ntimestep)},
                                  {"ranks", std::to_string(lmp->comm->nprocs)}};
    all.insert(all.end(), settings.begin(), settings.end());
    if (!ends_well(draft.file)) throw LSM::FileError("the file on disk is incomplete");
    LSM::seal_restart(draft.file, file, all);
  });
  if (!problem.empty()) lmp->error->all(FLERR, "Cannot write restart file {}: {}", file, problem);
}
