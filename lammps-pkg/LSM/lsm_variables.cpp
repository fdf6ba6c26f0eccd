// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_variables.h"

#include "comm.h"
#include "error.h"
#include "info.h"
#include "input.h"
#include "memory.h"
#include "tokenizer.h"
#include "variable.h"

#include "files/output_file.h"
#include "files/restart_info.h"
#include "lsm_ranks.h"
#include "lsm_script.h"
#include "lsm_variable_table.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

using namespace LAMMPS_NS;

// names and values of the variables that were not given
static const char *const DEFAULTS = "lsm_defaults";

static bool same(const std::string &one, const std::string &other)
{
  double a, b;
  return one == other || (LSM::text::parse(one, a) && LSM::text::parse(other, b) && a == b);
}

// lsm_variables FILE [also NAME ...] [new FILE ...]
void LSMVariables::command(int narg, char **arg)
{
  char **const end = arg + narg, **const files = std::find(arg, end, std::string("new"));
  if (files == arg || narg < 1 || (files > arg + 1 && strcmp(arg[1], "also") != 0))
    error->all(FLERR,
               "lsm_variables expects the name of a table, then 'also' with names and 'new' with "
               "files");
  const std::string path = LSMScript::beside(lmp, infile, arg[0], "lsm_variables");
  std::string text;
  if (comm->me == 0) {
    std::ifstream in(path);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  lsm_share(text, world);
  try {
    const LSMVariableTable table(text, path);
    refuse_repeated(table);
    forget_defaults(table);
    find_restart(table);
    known.assign(std::min(arg + 2, files), files);
    std::string names[2];
    for (const LSMSceneVariable &one : table.variables) {
      define(table, one);
      if (one.restart != LSMSceneVariable::NONE) names[0] += one.name + " ";
      if (one.header) names[1] += one.name + " ";
    }
    warn_of_others(table);
    refuse_ineffective(table);
    for (char **file = files; ++file < end;) refuse_earlier(*file);
    set(LSMScript::SAVED, "string", names[0]);
    set(LSMScript::HEADER, "string", names[1]);
    set(DEFAULTS, "string", defaults);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "lsm_variables: {}", e.what());
  }
}

bool LSMVariables::is_given(const std::string &name) const
{
  return std::count(given.begin(), given.end(), name) > 0;
}

// LAMMPS silently takes the first of two values; only the command line still shows the second
void LSMVariables::refuse_repeated(const LSMVariableTable &table) const
{
  std::string problem;
  if (comm->me == 0) {
    std::ifstream in("/proc/self/cmdline");
    std::vector<std::string> words;
    for (std::string word; std::getline(in, word, '\0');) words.push_back(word);
    std::map<std::string, std::string> first;
    for (std::size_t n = 0; n + 2 < words.size(); n++) {
      if ((words[n] != "-var" && words[n] != "-v") || !table.find(words[n + 1])) continue;
      // LAMMPS takes all words up to the next option, and the first of them as the value
      if (n + 3 < words.size() && words[n + 3].compare(0, 1, "-") != 0 && problem.empty())
        problem = fmt::format("Variable {} is given several values, '{}' and '{}'; give one, or "
                              "put its words in quotes",
                              words[n + 1], words[n + 2], words[n + 3]);
      const auto [at, is_new] = first.emplace(words[n + 1], words[n + 2]);
      if (!is_new && at->second != words[n + 2] && problem.empty())
        problem = fmt::format("Variable {} is given twice, as '{}' and as '{}'; leave one out",
                              at->first, at->second, words[n + 2]);
    }
  }
  lsm_share(problem, world);
  if (!problem.empty()) error->all(FLERR, "{}", problem);
}

// LAMMPS keeps variables when a script clears the simulation: those that were defaults of an
// earlier table, and still are what they were, are not given
void LSMVariables::forget_defaults(const LSMVariableTable &table)
{
  if (input->variable->find(DEFAULTS) < 0) return;
  for (const std::string &one : Tokenizer(value_now(DEFAULTS), "|").as_vector()) {
    const auto equals = one.find('=');
    const std::string name = one.substr(0, equals);
    const char *const value = input->variable->retrieve(name.c_str());
    if (table.find(name) && value && value == one.substr(equals + 1))
      input->variable->set(name + " delete");
  }
}

// a name misspelt on the command line is a variable that nothing reads
void LSMVariables::warn_of_others(const LSMVariableTable &table) const
{
  if (comm->me != 0) return;
  // LAMMPS' function has another type in each version
  int count = 0;
  const auto names = Info(lmp).get_variable_names(count);
  for (int n = 0; n < count; n++) {
    const std::string name = names[n];
    if (table.find(name) || name == LSMScript::SAVED || name == LSMScript::HEADER ||
        name == DEFAULTS)
      continue;
    if (!std::count(known.begin(), known.end(), name))
      error->warning(FLERR, "Variable {} is not used by this script", name);
  }
}

void LSMVariables::find_restart(const LSMVariableTable &table)
{
  for (const LSMSceneVariable &one : table.variables) {
    if (input->variable->find(one.name.c_str()) >= 0) given.push_back(one.name);
    if (one.is_restart_file() && is_given(one.name)) {
      define(table, one);
      restart = value_now(one.name);
    }
  }
  if (restart.empty()) return;
  const std::string problem = lsm_on_0(world, [this] {
    saved = LSM::check_restart(restart);
  });
  if (!problem.empty()) error->all(FLERR, "lsm_variables: {}", problem);
  std::string lines;
  for (const auto &[key, value] : saved) lines += key + " " + value + "\n";
  lsm_share(lines, world);
  saved.clear();
  for (const std::string &line : Tokenizer(lines, "\n").as_vector()) {
    const auto blank = line.find(' ');
    saved.emplace_back(line.substr(0, blank), line.substr(blank + 1));
  }
}

// returns the value of the restart file for a variable that continues from it
const std::string *LSMVariables::saved_value(const LSMSceneVariable &one)
{
  if (restart.empty() ||
      (one.restart != LSMSceneVariable::FIXED && one.restart != LSMSceneVariable::FREE))
    return nullptr;
  const std::string *const value = LSM::files::find(saved, one.name);
  if (!value && one.restart == LSMSceneVariable::FIXED && comm->me == 0)
    error->warning(FLERR, "Restart file {} has no value of {}: the given one is used", restart,
                   one.name);
  return value;
}

// A default that follows from other variables does so again if one of them is given anew.
bool LSMVariables::follows_others(const LSMVariableTable &table, const LSMSceneVariable &one,
                                  const std::string &value)
{
  if (one.restart != LSMSceneVariable::FREE) return false;
  const auto then = [this](const std::string &name) {
    const std::string *const found = LSM::files::find(saved, name);
    return found ? *found : value_now(name);
  };
  const auto now = [this](const std::string &name) {
    return value_now(name);
  };
  const std::string &text = table.default_of(one, then);
  const auto names = LSMVariableTable::named_in(text);
  return (text != table.default_of(one, now) ||
          std::any_of(names.begin(), names.end(),
                      [&](const std::string &name) {
                        return !same(value_now(name), then(name));
                      })) &&
      same(evaluated(LSMVariableTable::filled(text, then)), value);
}

// a variable that exists already was set on the command line, or by a script that includes this one
void LSMVariables::define(const LSMVariableTable &table, const LSMSceneVariable &one)
{
  const auto now = [this](const std::string &name) {
    return value_now(name);
  };
  const std::string *const then = saved_value(one);
  std::string value;
  if (is_given(one.name)) {
    value = value_now(one.name);
    if (then && same(value, *then)) {
      // the same number written differently is replaced by the old text, so that headers of
      // continued files match
      input->variable->set(one.name + " delete");
      set(one.name, "index", value = *then);
    } else if (then && one.restart == LSMSceneVariable::FIXED)
      error->all(FLERR,
                 "Variable {} is {}, but restart file {} was written with {} = {}, which it "
                 "cannot change; leave it out",
                 one.name, value, restart, one.name, *then);
  } else if (then && !follows_others(table, one, *then)) {
    set(one.name, "index", value = *then);
  } else if (one.optional) {
    return;
  } else {
    value = evaluated(LSMVariableTable::filled(table.default_of(one, now), now));
    set(one.name, "index", value);
  }
  for (const LSMVariableTable::Ignored &never : table.ignored)
    if (never.where.size() == 1 && never.where[0].first == one.name && !never.refused.empty() &&
        LSMSceneVariable::expected(value, never.where[0].second).empty())
      error->all(FLERR, "Variable {} is '{}', but {}", one.name, value, never.refused);
  const std::string expected = one.expected(value);
  if (!expected.empty())
    error->all(FLERR, "Variable {} is '{}', but must be {}", one.name, value, expected);
  if (one.accepted == LSMSceneVariable::SCENE) {
    // that scene reads the variables that it declares
    std::ifstream in(LSMScript::beside(lmp, infile, value + ".in", "Variable " + one.name));
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string command, name, style;
      if (words >> command >> name >> style && command == "variable" && style == "index")
        known.push_back(name);
    }
  }
  // LAMMPS' commands do not accept 1e5 as a whole number
  if (one.accepted.compare(0, 6, "whole ") == 0 && !utils::is_integer(value)) {
    input->variable->set(one.name + " delete");
    set(one.name, "index", fmt::format("{:.0f}", std::stod(value)));
  }
  if (!is_given(one.name)) defaults += one.name + "=" + value_now(one.name) + "|";
}

void LSMVariables::refuse_ineffective(const LSMVariableTable &table)
{
  const auto now = [this](const std::string &name) {
    return value_now(name);
  };
  for (const auto &[name, others] : table.replaced)
    for (const std::string &other : others) {
      if (!is_given(name) || !is_given(other)) continue;
      const LSMSceneVariable &one = *table.find(name);
      if (value_now(name) == evaluated(LSMVariableTable::filled(table.default_of(one, now), now)))
        continue;
      error->all(FLERR,
                 "Variable {} is '{}', but has no effect, as {} is given, too; leave one of them "
                 "out",
                 other, value_now(other), name);
    }
  for (const LSMVariableTable::Ignored &one : table.ignored) {
    std::string where;
    bool all = true;
    for (const auto &[name, accepted] : one.where) {
      const std::string value = value_now(name);
      all = all && LSMSceneVariable::expected(value, accepted).empty();
      where += (where.empty() ? "" : " and ") + name + " is " + value;
    }
    if (all && !one.refused.empty())
      error->all(FLERR, "Variable {}, but then {}", where, one.refused);
    for (const std::string &name : one.names) {
      if (!all || !is_given(name)) continue;
      // a run that began with this value may continue with it
      const std::string *const then = LSM::files::find(saved, name);
      if (then && same(value_now(name), *then)) continue;
      error->all(FLERR, "Variable {} is '{}', but has no effect, as {}; leave it out", name,
                 value_now(name), where);
    }
  }
}

// refuses to replace files right away, rather than when the run begins to write
void LSMVariables::refuse_earlier(const std::string &name) const
{
  if (!restart.empty() || value_now("overwrite") == "yes") return;
  const std::string file = LSMVariableTable::filled(name, [this](const std::string &variable) {
    return value_now(variable);
  });
  std::string there;
  if (comm->me == 0 && LSM::files::holds_data(file)) there = file;
  lsm_share(there, world);
  if (!there.empty())
    error->all(FLERR, "File {} exists; give another prefix, or replace it with overwrite yes",
               there);
}

std::string LSMVariables::value_now(const std::string &name) const
{
  const char *const value = input->variable->retrieve(name.c_str());
  if (!value) throw std::invalid_argument("variable " + name + " is needed before it is defined");
  return value;
}

// evaluates the formulas $(...) in a template as LAMMPS does
std::string LSMVariables::evaluated(const std::string &text) const
{
  if (text.find("$(") == std::string::npos) return text;
  int size = static_cast<int>(text.size()) + 1, scratch_size = 0;
  auto *buffer = static_cast<char *>(memory->smalloc(size, "lsm_variables"));
  char *scratch = nullptr;
  memcpy(buffer, text.c_str(), size);
  input->substitute(buffer, scratch, size, scratch_size, 0);
  const std::string value = buffer;
  memory->sfree(buffer);
  memory->sfree(scratch);
  return value;
}

void LSMVariables::set(const std::string &name, const char *style, std::string value)
{
  std::string words[] = {name, style, std::move(value)};
  char *arg[] = {words[0].data(), words[1].data(), words[2].data()};
  input->variable->set(3, arg);
}
