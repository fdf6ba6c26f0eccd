// SPDX-License-Identifier: GPL-2.0-or-later
// a run in pieces, each of which ends with a restart file

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(lsm_run,LSMRun);
// clang-format on
#else

#ifndef LMP_LSM_RUN_H
#define LMP_LSM_RUN_H

#include "command.h"

namespace LAMMPS_NS {

class LSMRun : public Command {
 public:
  LSMRun(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;

 private:
  std::string prefix;
  std::vector<std::string> further_variables;    // for the .info file
  std::vector<std::string> unused;               // files that this run does not write
  enum { KEEP, REFUSE, REMOVE };
  int earlier = KEEP;    // what becomes of files of an earlier run

  void save(const std::string &name);
  void remove(bigint step);
  std::vector<std::string> earlier_files() const;
  void refuse_earlier();
  void remove_earlier();
  bool stop_requested();
};

}    // namespace LAMMPS_NS

#endif
#endif
