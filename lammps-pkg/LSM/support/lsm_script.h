// SPDX-License-Identifier: GPL-2.0-or-later
// What the commands for scripts share, and restart files

#ifndef LMP_LSM_SCRIPT_H
#define LMP_LSM_SCRIPT_H

#include "files/parameters.h"

#include <cstdio>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;

namespace LSMScript {

  /// The path of a file that is named relative to the folder of the script; `who` begins the
  /// message if it cannot be read. The folder is known only if the script was given with -in or
  /// included.
  std::string beside(LAMMPS *, FILE *script, const std::string &name, const std::string &who);

  /// Stops if a name of restart files has * or %, which LAMMPS replaces; `who` begins the message.
  void require_plain(LAMMPS *, const std::string &who, const std::string &name);

  /// Names of variables that lsm_variables has left for others, in string-style variables.
  constexpr char SAVED[] = "lsm_saved", HEADER[] = "lsm_header";
  /// Those of a list with their values; empty if there is no such list.
  LSM::files::Parameters listed(LAMMPS *, const char *list);
  /// The value of a variable, or an error; `who` begins the message.
  std::string value_of(LAMMPS *, const std::string &name, const std::string &who);

  /// Writes a restart file as FILE.new, verifies it, and only then gives it its name and FILE.info.
  /// On all ranks. settings: of rank 0, for FILE.info. within_run: at the end of a step.
  void save_restart(LAMMPS *, const std::string &file, const LSM::files::Parameters &settings,
                    bool within_run);

}    // namespace LSMScript
}    // namespace LAMMPS_NS

#endif
