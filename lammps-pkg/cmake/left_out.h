// SPDX-License-Identifier: GPL-2.0-or-later
// Included before the sources of lmp_fault that have lists of styles: what it does without names
// lmp as the program to use. A command is one of these classes; a style that is not found may be
// misspelt, too.

#ifndef LSM_LEFT_OUT_H
#define LSM_LEFT_OUT_H

#include "command.h"
#include "error.h"
#include "input.h"
#include "utils.h"

namespace LAMMPS_NS {

class LSMLeftOut : public Command {
 public:
  using Command::Command;
  void command(int, char **) override {
    error->all(FLERR, "Unknown command: {}; lmp_fault has only what a fault needs, use lmp",
               input->command);
  }
};

namespace utils {
inline std::string lmp_fault_lacks(const std::string &style, const std::string &name, LAMMPS *lmp) {
  return check_packages_for_style(style, name, lmp) +
         "; lmp_fault has only what a fault needs, use lmp for all others";
}
}  // namespace utils
}  // namespace LAMMPS_NS

#define check_packages_for_style lmp_fault_lacks

#endif
