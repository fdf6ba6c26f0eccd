// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_run.h"

#include "comm.h"
#include "error.h"
#include "input.h"
#include "timer.h"
#include "update.h"
#include "variable.h"

#include "files/output_file.h"
#include "files/parameters.h"
#include "lsm_keyword_reader.h"
#include "lsm_ranks.h"
#include "lsm_script.h"

#include <filesystem>
#include <stdexcept>

using namespace LAMMPS_NS;
namespace fs = std::filesystem;

// lsm_run N prefix PREFIX every M [after STEP] [note NAME] ...
void LSMRun::command(int narg, char **arg)
{
  if (narg < 1) utils::missing_cmd_args(FLERR, "lsm_run (steps, prefix, every)", error);
  const bigint steps = utils::bnumeric(FLERR, arg[0], false, lmp);
  std::uint64_t of_piece = 0, first = 0;
  bool overwrite = false, resume = false, series = true, ruptures = true, history = true;
  LSMKeywordReader in(lmp, "lsm_run", 1, narg, arg);
  in.read_all({{"prefix", &prefix},
               {"every", &of_piece, LSM::Must::positive},
               {"after", &first},
               {"overwrite", &overwrite},
               {"resume", &resume},
               {"series", &series},
               {"ruptures", &ruptures},
               {"history", &history},
               {"note", LSM::Action{1, [&] {
                                      further_variables.emplace_back(in.text());
                                    }}}});
  in.require({"prefix", "every"});
  earlier = resume || !in.has("overwrite") ? KEEP : overwrite ? REMOVE : REFUSE;
  if (!series) unused.push_back(prefix + ".pe.bin");
  if (!ruptures) unused.push_back(prefix + ".ruptures.csv");
  if (!history) unused.push_back(prefix + ".slip.bin");

  const auto every = static_cast<bigint>(of_piece), after = static_cast<bigint>(first);
  const bigint last = after + steps;
  const bigint &step = update->ntimestep;
  if (step > last)
    error->all(FLERR, "lsm_run: steps = {}, but {} of them are done; give as many or more", steps,
               step - after);

  if (timer->is_timeout()) {    // LAMMPS leaves out all runs after one that a time limit ended
    if (comm->me == 0)
      utils::logmesg(lmp,
                     "lsm_run: stopped before its first step by the time limit of a run before "
                     "it; nothing is written\n");
    input->one("quit 75");
  }

  // found now and not by the first restart file
  for (const std::string &one : further_variables)
    if (input->variable->find(one.c_str()) < 0)
      error->all(FLERR, "lsm_run: there is no variable {}", one);
  LSMScript::require_plain(lmp, "lsm_run: prefix", prefix);
  const std::string problem = lsm_on_0(world, [this] {
    const fs::path folder = fs::absolute(prefix).parent_path();
    if (!fs::is_directory(folder))
      throw std::runtime_error("the folder of prefix " + prefix + " does not exist");
  });
  if (!problem.empty()) error->all(FLERR, "lsm_run: {}", problem);
  if (earlier == REFUSE) refuse_earlier();

  // Each piece begins with the set-up of a run (exchange, order of the particles in memory, lists)
  // and ends with a restart file, so that a run that continues from it repeats the uninterrupted
  // one to the last digit.
  do {
    const bigint done = step - after;
    const bigint next = MIN(after + (done < 0 ? 0 : done / every + 1) * every, last);
    input->one(fmt::format("run {} upto stop {} post no", next, last));
    // not before the files of the run are claimed: another run may still be writing them
    if (earlier == REMOVE) remove_earlier();
    earlier = KEEP;
    save(std::to_string(step));
    const bigint pieces = (step - after + every - 1) / every;
    if (pieces >= 2) remove(after + every * (pieces - 2));
    if (step < next && timer->is_timeout()) {    // LAMMPS would leave out all further pieces
      if (comm->me == 0)
        utils::logmesg(lmp, "Stopped at step {} by a time limit or fix halt\n", step);
      input->one("quit 75");
    }
    if (step < last && stop_requested()) {
      if (comm->me == 0)
        utils::logmesg(lmp, "Stopped at step {}, as there was a file {}.stop, which is removed\n",
                       step, prefix);
      input->one("quit 75");
    }
  } while (step < last);
  save("end");
  if (stop_requested() && comm->me == 0)
    error->warning(FLERR, "There was a file {}.stop, which is removed: the run has ended anyway",
                   prefix);
}

void LSMRun::save(const std::string &name)
{
  LSM::files::Parameters settings;
  for (const std::string &one : further_variables)
    settings.emplace_back(one, LSMScript::value_of(lmp, one, "lsm_run"));
  for (auto &one : LSMScript::listed(lmp, LSMScript::SAVED)) settings.push_back(std::move(one));
  LSMScript::save_restart(lmp, prefix + ".restart." + name, settings, false);
}

// lists restart files of this prefix and files that this run does not write, which would be
// mistaken for its own
std::vector<std::string> LSMRun::earlier_files() const
{
  std::vector<std::string> found;
  for (const std::string &file : unused)
    if (LSM::files::holds_data(file)) found.push_back(file);
  const fs::path base = prefix + ".restart.";
  const std::string begin = base.filename().string();
  std::error_code code;
  for (const auto &entry : fs::directory_iterator(fs::absolute(base, code).parent_path(), code)) {
    std::string step = entry.path().filename().string();
    if (step.compare(0, begin.size(), begin) != 0) continue;
    step = step.substr(begin.size(), step.rfind(".info") - begin.size());
    if (step == "end" || utils::is_integer(step)) found.push_back(entry.path().string());
  }
  return found;
}

void LSMRun::refuse_earlier()
{
  const std::string problem = lsm_on_0(world, [this] {
    for (const std::string &file : earlier_files())
      throw std::runtime_error(file +
                               " is there, of an earlier run; give another prefix, or replace its "
                               "files with overwrite yes");
  });
  if (!problem.empty()) error->all(FLERR, "lsm_run: {}", problem);
}

void LSMRun::remove_earlier()
{
  std::error_code code;
  if (comm->me == 0)
    for (const std::string &file : earlier_files()) fs::remove(file, code);
}

// removes a restart file; the two newest are kept
void LSMRun::remove(bigint step)
{
  if (comm->me != 0) return;
  const std::string file = prefix + ".restart." + std::to_string(step);
  std::error_code code;
  fs::remove(file + ".info", code);
  fs::remove(file, code);
}

bool LSMRun::stop_requested()
{
  int requested = 0;
  std::error_code code;
  if (comm->me == 0) requested = fs::remove(prefix + ".stop", code);
  MPI_Bcast(&requested, 1, MPI_INT, 0, world);
  return requested;
}
