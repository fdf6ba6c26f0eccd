// SPDX-License-Identifier: GPL-2.0-or-later
// the variables of a scene from a table: defaults, checks, values of a
// restart file, and what goes into headers

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(lsm_variables,LSMVariables);
// clang-format on
#else

#ifndef LMP_LSM_VARIABLES_H
#define LMP_LSM_VARIABLES_H

#include "command.h"

namespace LAMMPS_NS {
struct LSMSceneVariable;
class LSMVariableTable;

class LSMVariables : public Command {
 public:
  LSMVariables(class LAMMPS *_lmp) : Command(_lmp) {}
  void command(int, char **) override;

 private:
  std::string restart;    // the file that the run continues from, or ""
  std::vector<std::pair<std::string, std::string>> saved;    // the parameters in its .info file
  std::vector<std::string> given;                            // variables that were set before
  std::vector<std::string> known;                            // others that the script reads
  std::string defaults;                                      // NAME=VALUE| of those that were not

  bool is_given(const std::string &) const;
  void refuse_repeated(const LSMVariableTable &) const;
  void forget_defaults(const LSMVariableTable &);
  void warn_of_others(const LSMVariableTable &) const;
  void find_restart(const LSMVariableTable &);
  void define(const LSMVariableTable &, const LSMSceneVariable &);
  void refuse_ineffective(const LSMVariableTable &);
  void refuse_earlier(const std::string &) const;
  const std::string *saved_value(const LSMSceneVariable &);
  bool follows_others(const LSMVariableTable &, const LSMSceneVariable &, const std::string &);
  std::string value_now(const std::string &) const;
  std::string evaluated(const std::string &) const;
  void set(const std::string &name, const char *style, std::string value);
};

}    // namespace LAMMPS_NS

#endif
#endif
