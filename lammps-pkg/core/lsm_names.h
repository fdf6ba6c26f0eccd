// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_names.h
/// Enumerators and their words in options and headers, in one list: for an enumeration with a
/// function names_of(Enum), to_string() and from_string() follow.
#ifndef LSM_NAMES_H
#define LSM_NAMES_H

#include <string>
#include <string_view>

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

/// Returns false, and leaves value unchanged, if name is none of the words.
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

/// "a, b or c", for messages.
template <class Enum>
std::string choices(Enum any) {
  const auto names = names_of(any);
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 < names.size() ? ", " : " or ";
    out += names[i].name;
  }
  return out;
}

}  // namespace LSM

#endif
