// SPDX-License-Identifier: GPL-2.0-or-later
// include a file that lies beside the input script, wherever LAMMPS was
// started

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(include_beside,IncludeBeside);
// clang-format on
#else

#ifndef LMP_INCLUDE_BESIDE_H
#define LMP_INCLUDE_BESIDE_H

#include "command.h"

namespace LAMMPS_NS {

class IncludeBeside : public Command {
 public:
  IncludeBeside(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
