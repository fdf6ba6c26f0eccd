// SPDX-License-Identifier: GPL-2.0-or-later
// stop if a variable is not what a script can use

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(check_variable,CheckVariable);
// clang-format on
#else

#ifndef LMP_CHECK_VARIABLE_H
#define LMP_CHECK_VARIABLE_H

#include "command.h"

namespace LAMMPS_NS {

class CheckVariable : public Command {
 public:
  CheckVariable(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;

 private:
  void warn_of_others(int, char **);
};

}    // namespace LAMMPS_NS

#endif
#endif
