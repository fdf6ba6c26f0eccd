// SPDX-License-Identifier: GPL-2.0-or-later
/// \file replaced_file.h
/// Which files a program may replace unasked: what it wrote itself as the same output, known by how
/// the file begins, whatever its name. (Ours.)
#ifndef LSM_REPLACED_FILE_H
#define LSM_REPLACED_FILE_H

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "files/text_io.h"

namespace LSM {

/// Whether a file that begins with these bytes is an earlier one of the same output.
using Known = std::function<bool(std::string_view head)>;

inline Known begins_with(std::string text) {
  return [text = std::move(text)](std::string_view head) {
    return head.substr(0, text.size()) == text;
  };
}

/// What a file holds, by its first bytes, for messages.
inline std::string content_of(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, const char *> kinds[] = {
      {"# lsm-catalogue "sv, "a catalogue"},
      {"lsm-pe-series-"sv, "a PE series"},
      {"lsm-slip-hist-"sv, "a slip history"},
      {"LammpS RestartT"sv, "a restart file"},
      {"\xa3\x65\x63rc32"sv, "a checkpoint"}};
  const std::string_view program = text_io::compressed_by(head);
  if (!program.empty()) return "what " + std::string(program) + " has compressed";
  for (const auto &[mark, kind] : kinds)
    if (head.substr(0, mark.size()) == mark) return kind;
  return "something else";
}

/// Why a program must not replace path without being asked to, or "". \throws FileError if it
/// cannot be read
inline std::string why_kept(const std::string &path, const Known &known = nullptr) {
  if (!text_io::holds_data(path)) return {};
  constexpr std::size_t enough = 1 << 16;
  text_io::FileBytes file(path);
  const std::string_view head = file.peek(enough);
  if (known && known(head)) return {};
  return path + ": exists already and holds " + content_of(head) +
         ", expected a new name, or --overwrite to replace it";
}

}  // namespace LSM

#endif
