// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/parameters.h
/// Parameters of a run as headers of files hold them: lines "# key = value".
#ifndef LSM_PARAMETERS_H
#define LSM_PARAMETERS_H

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "files/text.h"

namespace LSM::files {

using Parameters = std::vector<std::pair<std::string, std::string>>;

const std::string *find(const Parameters &parameters, std::string_view key);

Parameters without(Parameters all, std::initializer_list<std::string_view> keys);

/// What the headers of all our files hold.
struct FileHeader {
  std::string model;      ///< "lsm" or "block-slider"
  Parameters parameters;  ///< the other ones, in the order of the file

  /// Versions of a binary format that there are, and that of this file, from 1 on.
  static constexpr int versions = 1;
  static constexpr int version() { return 1; }
  static void set_version(int) {}

  /// Value of one of the other parameters, or nullptr.
  const std::string *find(std::string_view key) const { return files::find(parameters, key); }
};

/// Reads the value of a required parameter. Returns what is wrong, or "".
template <class Value>
std::string take(const Parameters &parameters, const std::string &key, Value &value) {
  const std::string *text = find(parameters, key);
  if (!text)
    return "parameter '" + key + "' is missing in the header, expected '# " + key + " = value'";
  if constexpr (std::is_same_v<Value, std::string>)
    value = *text;
  else if (!text::parse(*text, value))
    return "parameter '" + key + "' is " + text::in_quotes(*text) + ", expected " +
           (std::is_integral_v<Value> ? "an integer" : "a finite number");
  return {};
}

/// Limit on the size of a header in bytes. Headers of runs have a few thousand; the limit protects
/// readers from small compressed files that unpack to gigabytes.
constexpr std::int64_t longest_header = 1 << 23;

/// Refuses keys and values that could not be read back as written.
/// \throws std::invalid_argument
void check_parameters(const Parameters &parameters);

/// One "# key = value" line per parameter.
std::string lines_of(const Parameters &parameters);

/// Splits "# key = value" at the first '='.
bool parse_parameter(std::string_view line, std::pair<std::string, std::string> &parameter);

/// Collects the parameters of a file that is being read. Keys are hashed, as a header may be long.
class ParameterList {
 public:
  /// Returns what is wrong with a key and its value, or "".
  using Check = std::string (*)(const std::string &key, const std::string &value);

  /// Adds a "# key = value" line; returns what is wrong, or "".
  std::string add_line(std::string_view line, Check check = nullptr);
  /// Adds the lines of a text, up to the first that is wrong.
  std::string add_lines(std::string_view text, Check check = nullptr);
  const Parameters &all() const { return all_; }

 private:
  Parameters all_;
  std::unordered_set<std::string> keys_;
};

/// Describes the first difference between the header of a file and the one that a resumed run would
/// write, or returns "". What may change when a run continues (header_keys.h) is no difference.
std::string difference(const Parameters &in_file, const Parameters &expected);
}  // namespace LSM::files

#endif
