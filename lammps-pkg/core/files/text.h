// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/text.h
/// Numbers as text that do not depend on the locale, and pieces of lines.
#ifndef LSM_TEXT_H
#define LSM_TEXT_H

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace LSM::text {

/// Writes 17 significant digits, so that reading them gives the same double.
template <class T>
void append(std::string &out, T value) {
  char buffer[64], *const end = buffer + sizeof(buffer);
  if constexpr (std::is_floating_point_v<T>)
    out.append(buffer, std::to_chars(buffer, end, value, std::chars_format::general, 17).ptr);
  else
    out.append(buffer, std::to_chars(buffer, end, value).ptr);
}

template <class T>
std::string number(T value) {
  std::string out;
  append(out, value);
  return out;
}

/// Succeeds only if the whole text is one finite number without blanks. The locale has no effect.
template <class T>
bool parse(std::string_view text, T &value) {
  T result{};
  const char *const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, result);
  if (parsed.ec != std::errc() || parsed.ptr != end) return false;
  if constexpr (std::is_floating_point_v<T>)
    if (!std::isfinite(result)) return false;
  value = result;
  return true;
}

std::string_view trim(std::string_view text);

/// Splits a line into views of it; n separators make n + 1 fields.
void split(std::string_view line, std::vector<std::string_view> &fields, char separator = ',');

/// Quotes part of a bad line for an error message, shortened and made printable.
std::string in_quotes(std::string_view text);

std::string where(const std::string &path, std::int64_t line);
}  // namespace LSM::text

#endif
