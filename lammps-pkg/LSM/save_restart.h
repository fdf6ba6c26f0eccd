// SPDX-License-Identifier: GPL-2.0-or-later
// write a restart file that has its name only when it is whole, with its
// checksum and the values of variables beside it

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(save_restart,SaveRestart);
// clang-format on
#else

#ifndef LMP_SAVE_RESTART_H
#define LMP_SAVE_RESTART_H

#include "command.h"
#include "lsm_text_io.h"

#include <string>

namespace LAMMPS_NS {

class SaveRestart : public Command {
 public:
  SaveRestart(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;

  /// On all ranks. settings: of rank 0, for FILE.info. within_run: at the end of a step.
  void save(const std::string &file, const LSM::text_io::Parameters &settings, bool within_run);
};

}    // namespace LAMMPS_NS

#endif
#endif
