// SPDX-License-Identifier: GPL-2.0-or-later
// compare a restart file with its checksum before it is read, and take
// over the values of variables that stand beside it

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(check_restart,CheckRestart);
// clang-format on
#else

#ifndef LMP_CHECK_RESTART_H
#define LMP_CHECK_RESTART_H

#include "command.h"

#include <string>

namespace LAMMPS_NS {

class CheckRestart : public Command {
 public:
  CheckRestart(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;

 private:
  void take(const std::string &file, const std::string &name, const std::string *value, bool fixed);
};

}    // namespace LAMMPS_NS

#endif
#endif
