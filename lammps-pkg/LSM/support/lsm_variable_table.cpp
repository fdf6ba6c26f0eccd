// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_variable_table.h"

#include "files/names.h"
#include "files/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <regex>
#include <sstream>
#include <stdexcept>

using namespace LAMMPS_NS;

static std::vector<std::string> split(const std::string &text, char separator)
{
  std::vector<std::string_view> fields;
  LSM::text::split(text, fields, separator);
  std::vector<std::string> parts;
  for (const std::string_view field : fields) parts.emplace_back(LSM::text::trim(field));
  return parts;
}

// "NAME VALUE"
static std::pair<std::string, std::string> name_and_value(const std::string &text)
{
  const std::string part(LSM::text::trim(text));
  const auto blank = part.find(' ');
  if (blank == std::string::npos)
    throw std::invalid_argument("expected a name and a value, but got '" + part + "'");
  return {part.substr(0, blank), std::string(LSM::text::trim(part.substr(blank)))};
}

// Names of files and free text reach the words of commands, so that only what is listed is
// accepted.
static bool consists_of(const std::string &value, const char *more)
{
  return std::all_of(value.begin(), value.end(), [more](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || (c != 0 && std::strchr(more, c));
  });
}

// "> 0", ">= 0" or "whole >= 1"
static bool is_bound(const std::string &accepted, std::smatch &bound, double &least)
{
  static const std::regex BOUND("(whole )?(>=?) (\\S+)");
  return std::regex_match(accepted, bound, BOUND) && LSM::text::parse(bound[3].str(), least);
}

std::string LSMSceneVariable::expected(const std::string &value, const std::string &accepted)
{
  if (accepted == "file" || accepted == RESTART_FILE || accepted == SCENE)
    return !value.empty() && value.front() != '-' && consists_of(value, "._-+=,@:/~")
        ? ""
        : "a file name of letters, digits and any of . _ - + = , @ : / ~ that does not "
          "begin with "
          "- (./-name is accepted)";
  if (accepted == "text")
    return consists_of(value, "._-+=,@:/~* ")
        ? ""
        : "words of letters, digits and any of . _ - + = , @ : / ~ *";

  double number = 0.0;
  const bool is_number = LSM::text::parse(value, number) && std::isfinite(number);
  if (accepted == "number") return is_number ? "" : "a number";
  if (accepted == "fraction")
    return is_number && number >= 0.0 && number < 1.0 ? ""
                                                      : "a number of at least 0 and less than 1";
  std::smatch bound;
  double least = 0.0;
  if (is_bound(accepted, bound, least)) {
    const bool whole = bound[1].matched;
    const bool good = is_number && (bound[2] == ">" ? number > least : number >= least) &&
        (!whole || number == std::floor(number));
    return good ? ""
                : (whole                 ? "a whole number of at least "
                       : bound[2] == ">" ? "a number above "
                                         : "a number of at least ") +
            bound[3].str();
  }
  const std::vector<std::string> words = split(accepted, ',');
  return std::count(words.begin(), words.end(), value) ? "" : LSM::either(words);
}

LSMVariableTable::LSMVariableTable(const std::string &text, const std::string &file)
{
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    number++;
    const std::string what(LSM::text::trim(line));
    if (what.empty() || what[0] == '#') continue;
    try {
      const auto colon = what.find(':'), replaces = what.find(" replaces "),
                 ignores = what.find(" ignores ");
      if (what.compare(0, 5, "when ") == 0 && colon != std::string::npos) {
        const auto condition = name_and_value(what.substr(5, colon - 5));
        for (const std::string &part : split(what.substr(colon + 1), ','))
          cases_.push_back({condition, name_and_value(part)});
        continue;
      }
      const std::vector<std::string> cells = split(what, '|');
      if (cells.size() == 1 && replaces != std::string::npos) {
        replaced.emplace_back(what.substr(0, replaces), split(what.substr(replaces + 10), ','));
        continue;
      }
      const bool never = what.compare(0, 6, "never ") == 0 && colon != std::string::npos;
      if (never || (cells.size() == 1 && ignores != std::string::npos)) {
        Ignored one;
        for (const std::string &part :
             split(never ? what.substr(6, colon - 6) : what.substr(0, ignores), '&'))
          one.where.push_back(name_and_value(part));
        if (never)
          one.refused = LSM::text::trim(what.substr(colon + 1));
        else
          one.names = split(what.substr(ignores + 9), ',');
        ignored.push_back(one);
        continue;
      }
      static const std::vector<std::string> RESTART = {"fixed", "free", "noted", "-"};
      if (cells.size() != 7)
        throw std::invalid_argument("expected 7 columns: name, default, values, restart, header, "
                                    "unit and meaning, separated by |");
      const auto restart = std::find(RESTART.begin(), RESTART.end(), cells[3]) - RESTART.begin();
      if (cells[3] != "-" && restart == static_cast<long>(RESTART.size()))
        throw std::invalid_argument("restart is '" + cells[3] + "', but must be " +
                                    LSM::either(RESTART));
      std::smatch bound;
      double least;
      if (cells[2].find_first_of("<>") != std::string::npos && !is_bound(cells[2], bound, least))
        throw std::invalid_argument("values are '" + cells[2] +
                                    "', but a bound must be > or >= and a number");
      if (cells[4] != "header" && cells[4] != "-")
        throw std::invalid_argument("header is '" + cells[4] + "', but must be header or -");
      if (find(cells[0])) throw std::invalid_argument("a second variable " + cells[0]);
      variables.push_back({cells[0], cells[1], cells[1] == "-", cells[2],
                           static_cast<LSMSceneVariable::Restart>(restart), cells[4] == "header"});
    } catch (const std::invalid_argument &e) {
      throw std::invalid_argument(LSM::text::where(file, number) + e.what());
    }
  }
  const auto known = [&](const std::string &name) {
    if (!find(name)) throw std::invalid_argument(file + ": there is no variable " + name);
  };
  for (const Case &one : cases_) {
    known(one.condition.first);
    known(one.then.first);
  }
  for (const auto &[name, others] : replaced) {
    known(name);
    for (const std::string &other : others) known(other);
  }
  for (const Ignored &one : ignored) {
    for (const auto &condition : one.where) known(condition.first);
    for (const std::string &name : one.names) known(name);
  }
}

const LSMSceneVariable *LSMVariableTable::find(const std::string &name) const
{
  const auto at =
      std::find_if(variables.begin(), variables.end(), [&](const LSMSceneVariable &one) {
        return one.name == name;
      });
  return at == variables.end() ? nullptr : &*at;
}

const std::string &LSMVariableTable::default_of(const LSMSceneVariable &variable,
                                                const Lookup &lookup) const
{
  const std::string *text = &variable.otherwise;
  for (const Case &one : cases_)
    if (one.then.first == variable.name && lookup(one.condition.first) == one.condition.second)
      text = &one.then.second;
  return *text;
}

static const std::regex NAMED("\\$\\{(\\w+)\\}|\\bv_(\\w+)");

std::vector<std::string> LSMVariableTable::named_in(const std::string &text)
{
  std::vector<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), NAMED), end; at != end; ++at)
    names.push_back((*at)[1].matched ? (*at)[1] : (*at)[2]);
  return names;
}

std::string LSMVariableTable::filled(const std::string &text, const Lookup &lookup)
{
  std::string out;
  auto rest = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), NAMED), end; at != end; ++at) {
    out.append(rest, (*at)[0].first);
    out += lookup((*at)[1].matched ? (*at)[1] : (*at)[2]);
    rest = (*at)[0].second;
  }
  return out.append(rest, text.end());
}
