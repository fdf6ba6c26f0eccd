// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/parameters.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <unordered_map>

#include "files/header_keys.h"

namespace LSM::files {

const std::string *find(const Parameters &parameters, std::string_view key) {
  for (const auto &parameter : parameters)
    if (parameter.first == key) return &parameter.second;
  return nullptr;
}

Parameters without(Parameters all, std::initializer_list<std::string_view> keys) {
  const auto unwanted = [&keys](const auto &parameter) {
    return std::find(keys.begin(), keys.end(), parameter.first) != keys.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  return all;
}

void check_parameters(const Parameters &parameters) {
  std::unordered_set<std::string_view> keys;
  std::size_t bytes = 0;
  for (const auto &[key, value] : parameters) {
    bytes += key.size() + value.size() + std::string_view("#  = \n").size();
    if (bytes > longest_header)
      throw std::invalid_argument("file header: longer than " + std::to_string(longest_header) +
                                  " bytes");
    if (key.empty() || text::trim(key) != key || key.find_first_of("=\n\r") != std::string::npos)
      throw std::invalid_argument("file header: parameter name " + text::in_quotes(key) +
                                  " is empty or has blanks around it, '=' or a line break");
    if (value.find_first_of("\n\r") != std::string::npos)
      throw std::invalid_argument("file header: value of parameter " + text::in_quotes(key) +
                                  " has a line break");
    if (!keys.insert(key).second)
      throw std::invalid_argument("file header: parameter " + text::in_quotes(key) +
                                  " given twice");
  }
}

std::string lines_of(const Parameters &parameters) {
  std::string out;
  for (const auto &[key, value] : parameters) {
    out += "# " + key + " = ";
    out += text::trim(value);
    out += '\n';
  }
  return out;
}

bool parse_parameter(std::string_view line, std::pair<std::string, std::string> &parameter) {
  if (line.empty() || line.front() != '#') return false;
  line.remove_prefix(1);
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string_view key = text::trim(line.substr(0, equals));
  if (key.empty()) return false;
  parameter.first = std::string(key);
  parameter.second = std::string(text::trim(line.substr(equals + 1)));
  return true;
}

std::string ParameterList::add_line(std::string_view line, Check check) {
  std::pair<std::string, std::string> parameter;
  if (!parse_parameter(line, parameter))
    return "header line " + text::in_quotes(line) + ", expected '# key = value'";
  const auto &[key, value] = parameter;
  const std::string problem = check ? check(key, value) : "";
  if (!problem.empty()) return problem;
  if (!keys_.insert(key).second)
    return "parameter " + text::in_quotes(key) + " given twice, expected once";
  all_.push_back(std::move(parameter));
  return {};
}

std::string ParameterList::add_lines(std::string_view text, Check check) {
  for (std::int64_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string problem = add_line(text.substr(0, end), check);
    if (!problem.empty()) return "header line " + std::to_string(number) + ": " + problem;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

std::string difference(const Parameters &in_file, const Parameters &expected) {
  const auto ignored = [](const std::string &key) {
    const HeaderKey *const known = header_key(key);
    return known && known->may_change;
  };
  using Values = std::unordered_map<std::string_view, std::string_view>;
  const Values found(in_file.begin(), in_file.end()), known(expected.begin(), expected.end());
  for (const auto &[key, value] : expected) {
    if (ignored(key)) continue;
    const std::string wanted(text::trim(value));
    const auto there = found.find(key);
    if (there == found.end())
      return "parameter '" + key + "' is missing in the file, expected '" + wanted + "'";
    if (there->second != wanted)
      return "parameter '" + key + "' is '" + std::string(there->second) +
             "' in the file, expected '" + wanted + "'";
  }
  for (const auto &[key, value] : in_file)
    if (!ignored(key) && known.count(key) == 0)
      return "parameter '" + key + "' is '" + value + "' in the file, expected no such parameter";
  return {};
}

}  // namespace LSM::files
