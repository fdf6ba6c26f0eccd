// SPDX-License-Identifier: GPL-2.0-or-later
#include "option_group.h"

#include <algorithm>
#include <limits>

#include <CLI/CLI.hpp>

#include "files/text.h"

namespace LSM {

namespace {

Rule check(const CLI::Validator &validator) {
  return [validator](CLI::Option &option) { option.check(validator); };
}

Rule transform(const CLI::Validator &validator) {
  return [validator](CLI::Option &option) { option.transform(validator); };
}

/// Allows the numbers that the predicate `good` accepts. name: beside the type in --help
template <class Number, class Good>
Rule number_that(Good good, const std::string &expected, const char *name = "") {
  return check(CLI::Validator(
      [good, expected](std::string &text) {
        Number value{};
        return text::parse(text, value) && good(value)
                   ? std::string()
                   : "expected " + expected + ", not " + text::in_quotes(text);
      },
      name));
}

/// Shows defaults as CLI11 2.1 does, FLOAT=1, and not as later versions do, FLOAT [1], and none for
/// an empty list, so that --help is the same with every version.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option *option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string value = option->get_default_str();
    if (value.empty()) return text;
    for (const std::string &shown : {" [" + value + "] ", "=" + value})
      if (const auto at = text.find(shown); at != std::string::npos)
        return text.replace(at, shown.size(), value == "[]" || value == "{}" ? "" : "=" + value);
    return text;
  }
};

CLI::Option *put(CLI::Option *option, const std::string &heading, const std::vector<Rule> &rules) {
  for (const Rule &rule : rules) rule(*option);
  return option->group(heading);
}

}  // namespace

Rule required() {
  return [](CLI::Option &option) { option.required(); };
}
Rule one_each() {
  return [](CLI::Option &option) { option.allow_extra_args(false); };
}
Rule values(int count) {
  return [count](CLI::Option &option) {
    option.expected(count)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  };
}
Rule shown(const std::string &value) {
  return [value](CLI::Option &option) { option.default_str(value); };
}
Rule kind(const std::string &of_value) {
  return [of_value](CLI::Option &option) { option.type_name(of_value); };
}
Rule more_help(const std::string &text) {
  return [text](CLI::Option &option) { option.description(option.get_description() + text); };
}
Rule excludes(CLI::Option *other) {
  return [other](CLI::Option &option) { option.excludes(other); };
}
Rule needs(CLI::Option *other) {
  return [other](CLI::Option &option) { option.needs(other); };
}
Rule positive() {
  return number_that<double>([](double value) { return value > 0.0; }, "a number above 0",
                             "POSITIVE");
}
Rule between(std::int64_t lo, std::int64_t hi) { return check(CLI::Range(lo, hi)); }
Rule among(const std::vector<std::string> &words) { return check(CLI::IsMember(words)); }
Rule zero_or_more() {
  return number_that<double>([](double value) { return value >= 0.0; }, "a number of 0 or more");
}
Rule finite() {
  return number_that<double>([](double) { return true; }, "a finite number");
}
Rule transformed(const std::function<std::string(std::string &)> &change) {
  return transform(CLI::Validator(change, ""));
}

template <class Value>
CLI::Option *OptionGroup::bind(const std::string &names, Value &value, const std::string &help,
                               const std::vector<Rule> &rules) {
  return put(command_->add_option(names, value, help), heading_, rules);
}
#define LSM_BIND(Value)                                                                      \
  template CLI::Option *OptionGroup::bind(const std::string &, Value &, const std::string &, \
                                          const std::vector<Rule> &);
LSM_BIND(double)
LSM_BIND(int)
LSM_BIND(std::int64_t)
LSM_BIND(std::uint64_t)
LSM_BIND(std::string)
LSM_BIND(std::optional<double>)
LSM_BIND(std::optional<std::string>)
LSM_BIND(std::vector<double>)
LSM_BIND(std::vector<std::string>)
#undef LSM_BIND

template <class Value>
CLI::Option *OptionGroup::bind_call(const std::string &names,
                                    const std::function<void(const Value &)> &use,
                                    const std::string &help, const std::vector<Rule> &rules) {
  return put(command_->add_option_function(names, use, help), heading_, rules);
}
#define LSM_BIND_CALL(Value)                                                               \
  template CLI::Option *OptionGroup::bind_call(const std::string &,                        \
                                               const std::function<void(const Value &)> &, \
                                               const std::string &, const std::vector<Rule> &);
LSM_BIND_CALL(double)
LSM_BIND_CALL(std::string)
LSM_BIND_CALL(std::vector<std::string>)
#undef LSM_BIND_CALL

CLI::Option *OptionGroup::bind_flag(const std::string &names, bool &value, const std::string &help,
                                    const std::vector<Rule> &rules) {
  return put(command_->add_flag(names, value, help), heading_, rules);
}

void OptionGroup::remove(const char *name) { command_->remove_option(command_->get_option(name)); }

void add_seed(OptionGroup group, std::uint64_t &seed, const std::string &help) {
  // CLI11 would turn negative numbers into huge ones, and numbers that are too large into the
  // largest one.
  const auto most = std::to_string(std::numeric_limits<std::uint64_t>::max());
  const auto any = [](std::uint64_t) { return true; };
  group.add("--seed", seed, help,
            number_that<std::uint64_t>(any, "a whole number from 0 to " + most));
}

void set_up(CLI::App &program, const std::string &version) {
  program.set_version_flag("--version", version);
  program.option_defaults()->always_capture_default();
  program.formatter(std::make_shared<HelpFormatter>());
  program.get_formatter()->column_width(34);
}

std::optional<int> parse(CLI::App &program, std::vector<std::string> arguments) {
  // CLI11 expects the arguments in reverse order.
  std::reverse(arguments.begin(), arguments.end());
  try {
    program.parse(std::move(arguments));
    return {};
  } catch (const CLI::Success &asked_for) {
    return program.exit(asked_for);
  } catch (const CLI::ParseError &error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw std::invalid_argument(what + " (--help lists the options)");
  }
}

}  // namespace LSM
