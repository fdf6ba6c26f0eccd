// SPDX-License-Identifier: GPL-2.0-or-later
/// \file option_group.h
/// The options of the programs: where a value is stored, and rules for what it may be. CLI11 takes
/// long to compile, so only option_group.cpp and the main programs include it.
#ifndef LSM_OPTION_GROUP_H
#define LSM_OPTION_GROUP_H

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "files/names.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace LSM {

/// A rule for an option: which values are allowed, and how --help shows it.
using Rule = std::function<void(CLI::Option &)>;
Rule required();
Rule one_each();                         ///< a single value each time the option is given
Rule values(int count);                  ///< exactly this many values each time
Rule shown(const std::string &value);    ///< the default that --help shows
Rule kind(const std::string &of_value);  ///< kind of value that --help shows in place of TEXT
Rule more_help(const std::string &text);
Rule excludes(CLI::Option *other);
Rule needs(CLI::Option *other);
Rule positive();
Rule zero_or_more();
Rule finite();
Rule between(std::int64_t lo, std::int64_t hi);
Rule among(const std::vector<std::string> &words);
/// Applies a function that changes the text of the value or returns what is wrong with it.
Rule transformed(const std::function<std::string(std::string &)> &change);

/// Options under one heading of --help.
class OptionGroup {
 public:
  explicit OptionGroup(CLI::App *command, std::string heading = "Options")
      : command_(command), heading_(std::move(heading)) {}

  /// Adds an option that sets a variable.
  /// \tparam Value a number, a text, or an optional or vector of these
  template <class Value, class... Rules>
  CLI::Option *add(const std::string &names, Value &value, const std::string &help,
                   const Rules &...rules) {
    return bind(names, value, help, {Rule(rules)...});
  }
  /// Adds an option that calls a function with its value.
  /// \tparam Value a number, a text, or a vector of all given texts
  template <class Value, class... Rules>
  CLI::Option *call(const std::string &names, const std::function<void(const Value &)> &use,
                    const std::string &help, const Rules &...rules) {
    return bind_call(names, use, help, {Rule(rules)...});
  }
  /// Adds an option whose value is one of the words of an enumeration (see files/names.h).
  template <class Enum, class... Rules>
  CLI::Option *choose(const std::string &name, Enum &value, const std::string &help,
                      const Rules &...rules) {
    const auto take = [name, &value](const std::string &word) {
      if (!from_string(word, value))
        throw std::invalid_argument(name + " = '" + word + "', expected " + choices(value));
    };
    return call<std::string>(name, take, help, shown(to_string(value)), rules...);
  }
  template <class... Rules>
  CLI::Option *flag(const std::string &names, bool &value, const std::string &help,
                    const Rules &...rules) {
    return bind_flag(names, value, help, {Rule(rules)...});
  }
  void remove(const char *name);

 private:
  template <class Value>
  CLI::Option *bind(const std::string &names, Value &value, const std::string &help,
                    const std::vector<Rule> &rules);
  template <class Value>
  CLI::Option *bind_call(const std::string &names, const std::function<void(const Value &)> &use,
                         const std::string &help, const std::vector<Rule> &rules);
  CLI::Option *bind_flag(const std::string &names, bool &value, const std::string &help,
                         const std::vector<Rule> &rules);
  CLI::App *command_;
  std::string heading_;
};

/// Adds --seed.
void add_seed(OptionGroup group, std::uint64_t &seed,
              const std::string &help = "Seed of the random numbers");

/// Sets what all programs have in common: --version, and the layout and default values of --help.
void set_up(CLI::App &program, const std::string &version);

/// Reads a command line.
/// \return an exit status if --help or --version was given and has been printed
/// \throws std::invalid_argument with one line
std::optional<int> parse(CLI::App &program, std::vector<std::string> arguments);

}  // namespace LSM

#endif
