// SPDX-License-Identifier: GPL-2.0-or-later
// The variables of a scene, each declared by one line of a table; see doc/lsm_variables.rst

#ifndef LMP_LSM_VARIABLE_TABLE_H
#define LMP_LSM_VARIABLE_TABLE_H

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// A line of the table.
struct LSMSceneVariable {
  enum Restart { FIXED, FREE, NOTED, NONE };

  std::string name;
  std::string otherwise;    ///< default, a template with ${NAME} and $(formula)
  bool optional;            ///< there is no default: not defined unless given
  std::string accepted;     ///< what the value may be, as the table has it
  Restart restart;    ///< of FREE and FIXED a continued run takes the value from the restart file
  bool header;        ///< goes into the headers of catalogues and series

  /// What the value must be, for messages, or "" if it is accepted.
  std::string expected(const std::string &value) const { return expected(value, accepted); }
  static std::string expected(const std::string &value, const std::string &accepted);
  static constexpr const char *RESTART_FILE = "restart file", *SCENE = "scene";
  bool is_restart_file() const { return accepted == RESTART_FILE; }
};

class LSMVariableTable {
 public:
  using Lookup = std::function<std::string(const std::string &)>;

  std::vector<LSMSceneVariable> variables;
  /// A variable, and others that have no effect if it is given.
  std::vector<std::pair<std::string, std::vector<std::string>>> replaced;
  /// Variables, each with what it must be, and others that have no effect where all of them are;
  /// or why all of them must not be so.
  struct Ignored {
    std::vector<std::pair<std::string, std::string>> where;
    std::vector<std::string> names;
    std::string refused;
  };
  std::vector<Ignored> ignored;

  /// \throws std::invalid_argument, one line that begins with the name of the file and the line
  LSMVariableTable(const std::string &text, const std::string &file);

  const LSMSceneVariable *find(const std::string &name) const;
  /// The template of the default where other variables have the values of lookup().
  const std::string &default_of(const LSMSceneVariable &, const Lookup &lookup) const;
  /// Other variables that a template refers to, ${NAME} or v_NAME.
  static std::vector<std::string> named_in(const std::string &text);
  /// The template with the values of lookup() in place of their names.
  static std::string filled(const std::string &text, const Lookup &lookup);

 private:
  struct Case {
    std::pair<std::string, std::string> condition, then;    ///< variable and value
  };
  std::vector<Case> cases_;
};

}    // namespace LAMMPS_NS

#endif
