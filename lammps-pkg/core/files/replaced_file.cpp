// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/replaced_file.h"

#include <cstddef>
#include <utility>

#include "files/input_bytes.h"
#include "files/output_file.h"

namespace LSM {

Known begins_with(std::string text) {
  return [text = std::move(text)](std::string_view head) {
    return head.substr(0, text.size()) == text;
  };
}

std::string content_of(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, const char *> kinds[] = {
      {"# lsm-catalogue "sv, "a catalogue"},
      {"lsm-pe-series-"sv, "a PE series"},
      {"lsm-slip-hist-"sv, "a slip history"},
      {"LammpS RestartT"sv, "a restart file"},
      {"slider_cli checkpoint "sv, "a checkpoint"}};
  const std::string_view program = files::compressed_by(head);
  if (!program.empty()) return "what " + std::string(program) + " has compressed";
  for (const auto &[mark, kind] : kinds)
    if (head.substr(0, mark.size()) == mark) return kind;
  return "something else";
}

std::string why_kept(const std::string &path, const Known &known) {
  if (!files::holds_data(path)) return {};
  constexpr std::size_t enough = 1 << 16;
  files::FileBytes file(path);
  const std::string_view head = file.peek(enough);
  if (known && known(head)) return {};
  return path + ": exists already and holds " + content_of(head) +
         ", expected a new name, or --overwrite to replace it";
}

}  // namespace LSM
