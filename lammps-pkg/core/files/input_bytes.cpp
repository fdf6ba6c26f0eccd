// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/input_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "files/file_error.h"

namespace LSM::files {

std::size_t Bytes::read(char *to, std::size_t most) {
  const std::size_t known = std::min(most, ahead_.size());
  std::memcpy(to, ahead_.data(), known);
  ahead_.erase(0, known);
  return known == most ? known : known + more(to + known, most - known);
}

std::string_view Bytes::peek(std::size_t count) {
  const std::size_t known = ahead_.size();
  if (known < count) {
    ahead_.resize(count);
    ahead_.resize(known + more(ahead_.data() + known, count - known));
  }
  return std::string_view(ahead_).substr(0, count);
}

FileBytes::FileBytes(const std::string &path) : Bytes(path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw FileError(path + ": is a directory, expected a file");
  errno = 0;
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw FileError(path + ": cannot open: " + std::generic_category().message(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

std::int64_t FileBytes::size() const {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path(), code)) return -1;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path(), code));
  if (code) throw FileError(path() + ": cannot read: " + code.message());
  return size;
}

std::size_t FileBytes::more(char *to, std::size_t most) {
  errno = 0;
  const std::size_t got = std::fread(to, 1, most, file_.get());
  if (got < most && std::ferror(file_.get()))
    throw FileError(path() + ": cannot read: " + std::generic_category().message(errno));
  return got;
}

std::string_view compressed_by(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"\x1f\x8b"sv, "gzip"},
      {"\xfd"
       "7zXZ\0"sv,
       "xz"},
      {"BZh"sv, "bzip2"},
      {"PK\3\4"sv, "zip"},
      {"\x28\xb5\x2f\xfd"sv, "zstd"}};
  for (const auto &[mark, program] : known)
    if (head.substr(0, mark.size()) == mark) return program;
  return {};
}

std::string_view compressed_by(Bytes &file) { return compressed_by(file.peek(6)); }

std::unique_ptr<Bytes> open_plain(const std::string &path) {
  auto bytes = std::make_unique<FileBytes>(path);
  const std::string_view program = compressed_by(*bytes);
  if (!program.empty())
    throw FileError(path + ": compressed by " + std::string(program) +
                    ", expected a file that is not");
  return bytes;
}

bool is_utf16(std::string_view head) {
  if (head.substr(0, 2) == "\xff\xfe" || head.substr(0, 2) == "\xfe\xff") return true;
  // Without a mark: each letter has a byte of 0 before or after it.
  const auto zero = [head](std::size_t i) { return i < head.size() && head[i] == '\0'; };
  return head.size() >= 4 && zero(0) == zero(2) && zero(1) == zero(3) && zero(0) != zero(1);
}

}  // namespace LSM::files
