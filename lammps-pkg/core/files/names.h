// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/names.h
/// Names of enumerators in options and headers. An enumeration needs a function names_of(Enum),
/// which lists them; to_string() and from_string() follow from it.
#ifndef LSM_NAMES_H
#define LSM_NAMES_H

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace LSM {

template <class Enum>
struct Named {
  Enum value;
  const char *name;
};

template <class Enum>
constexpr auto to_string(Enum value) -> decltype(names_of(value)[0].name) {
  for (const auto &named : names_of(value))
    if (named.value == value) return named.name;
  return "unknown";
}

/// Returns false, and leaves value unchanged, if there is no such name.
template <class Enum>
constexpr auto from_string(std::string_view name, Enum &value)
    -> decltype(names_of(value)[0].name, bool()) {
  for (const auto &named : names_of(value)) {
    if (name != named.name) continue;
    value = named.value;
    return true;
  }
  return false;
}

/// Joins words for messages, as "a, b or c".
template <class Words>
std::string either(const Words &words, const char *last = " or ") {
  std::string out;
  auto left = std::size(words);
  for (const auto &word : words) {
    out.append(out.empty() ? "" : left > 1 ? ", " : last).append(word);
    --left;
  }
  return out;
}

template <class Enum>
std::string choices(Enum any) {
  std::vector<std::string> words;
  for (const auto &named : names_of(any)) words.emplace_back(named.name);
  return either(words);
}

}  // namespace LSM

#endif
