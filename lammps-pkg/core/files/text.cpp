// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/text.h"

namespace LSM::text {

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

void split(std::string_view line, std::vector<std::string_view> &fields, char separator) {
  fields.clear();
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (char c : text.substr(0, longest)) {
    const bool printable = static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
    out += printable ? c : '?';
  }
  if (text.size() > longest) out += "...";
  return out + "'";
}

std::string where(const std::string &path, std::int64_t line) {
  return path + ":" + std::to_string(line) + ": ";
}

}  // namespace LSM::text
