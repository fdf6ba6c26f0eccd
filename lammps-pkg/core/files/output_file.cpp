// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/output_file.h"

#include <fcntl.h>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/output_claim.h"

namespace LSM::files {

namespace {

/// Opens a file for writing, at its end unless `anew`. Returns nullptr and sets errno on failure.
/// Temporary files are opened without following links: their names can be guessed, so somebody else
/// may have put a link there.
std::FILE *open_for_writing(const std::string &path, bool anew, bool follow = true) {
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | (anew ? O_TRUNC : O_APPEND);
  const int file = ::open(path.c_str(), flags | (follow ? 0 : O_NOFOLLOW), 0666);
  return file < 0 ? nullptr : fdopen(file, anew ? "wb" : "ab");
}

}  // namespace

std::string why_not_opened(const std::string &path, const std::string &opened, int reason) {
  if (reason == ELOOP && opened != path)
    return path + ": cannot write: its temporary file " + opened +
           " is a symbolic link; move it away";
  return path + ": cannot open for writing: " + std::generic_category().message(reason);
}

bool holds_data(const std::string &path) {
  std::error_code code;
  return !path.empty() && std::filesystem::is_regular_file(path, code) &&
         std::filesystem::file_size(path, code) > 0 && !code;
}

std::string why_not_writable(const std::string &path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return path + ": is a directory, expected a file name";
  const bool there = std::filesystem::exists(path, code);
  // Opening a pipe just to test it would be noticed by its reader.
  if (there && !std::filesystem::is_regular_file(path, code)) return {};
  // A file that exists is written in place, or replaced by a new one beside it.
  for (const std::string &tried : {path, path + ".new"}) {
    const bool was_there = std::filesystem::exists(tried, code);
    if (tried == path && !was_there) continue;
    std::FILE *const file = open_for_writing(tried, false, tried == path);
    if (!file) return why_not_opened(path, tried, errno);
    std::fclose(file);
    if (!was_there) std::filesystem::remove(tried, code);
  }
  return {};
}

void sync(const std::string &path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = file < 0 || fsync(file) != 0;
  const int reason = errno;
  if (file >= 0) ::close(file);
  // Some file systems cannot synchronise folders.
  if (failed && (file < 0 || reason != EINVAL))
    throw FileError(path + ": cannot write: " + std::generic_category().message(reason));
}

void OutputFile::create(const std::string &path, std::string_view text, bool whole) {
  namespace fs = std::filesystem;
  close();
  std::error_code code;
  // The file that a link points to is replaced, not the link. Devices and pipes cannot be replaced.
  name_ = fs::is_symlink(path, code) ? fs::weakly_canonical(path, code).string() : path;
  if (code) name_ = path;
  written_ = name_;
  const fs::file_status status = fs::status(name_, code);
  if (fs::is_directory(status)) throw FileError(path + ": is a directory, expected a file name");
  const bool special = fs::exists(status) && !fs::is_regular_file(status);
  open(path, special ? name_ : name_ + ".new", true);
  write(text);
  if (!whole) take_name();
}

void OutputFile::keep(const std::string &path, std::int64_t bytes) {
  close();
  name_ = written_ = path;
  kept_ = static_cast<std::uintmax_t>(bytes);
}

void OutputFile::append() {
  // The file is opened first, so that it is not truncated without permission to write.
  open(name_, name_, false);
  std::error_code code;
  if (std::filesystem::file_size(name_, code) != kept_ && !code)
    std::filesystem::resize_file(name_, kept_, code);
  if (code) give_up("cannot truncate", code);
}

void OutputFile::append(std::string_view header, std::int64_t old) {
  FileBytes in(name_);
  std::string block(1 << 20, '\0');
  const auto next = [&](std::uintmax_t most) {
    const std::size_t got = in.read(block.data(), std::min<std::uintmax_t>(most, block.size()));
    return std::string_view(block).substr(0, got);
  };
  const auto length = static_cast<std::uintmax_t>(old);
  if (next(length) == header) return append();
  const std::uintmax_t kept = kept_;
  create(name_, header, true);
  for (std::uintmax_t done = length; done < kept;) {
    const std::string_view part = next(kept - done);
    if (part.empty()) give_up("cannot read");
    write(part);
    done += part.size();
  }
  sync();
  take_name();
}

void OutputFile::write(std::string_view text) {
  if (!file_) throw FileError("output file is not open");
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
    give_up("cannot write");
}

void OutputFile::sync() {
  if (fsync(fileno(file_)) != 0) give_up("cannot write");
}

void OutputFile::close() {
  if (!file_) return;
  errno = 0;
  if (std::fclose(std::exchange(file_, nullptr)) != 0) give_up("cannot write");
  take_name();
}

void OutputFile::take_name() {
  if (written_ == name_) return;
  if (!FileLock::rename(written_, name_)) give_up("cannot create");
  written_ = name_;
}

void OutputFile::give_up(const char *what, std::error_code why) {
  discard();
  throw FileError(path_ + ": " + what + ": " + why.message());
}

void OutputFile::discard() {
  if (file_) std::fclose(std::exchange(file_, nullptr));
  if (written_ != name_) std::remove(written_.c_str());
  written_ = name_;
}

void OutputFile::open(const std::string &shown, const std::string &opened, bool anew) {
  path_ = shown;
  file_ = open_for_writing(opened, anew, opened == name_);
  if (!file_) throw FileError(why_not_opened(path_, opened, errno));
  written_ = opened;
  std::setvbuf(file_, nullptr, _IONBF, 0);
}

void ResumableFile::refuse(const std::string &path, const std::string &why) {
  throw FileError(path + ": cannot resume: " + why);
}

void write_file(const std::string &path, std::string_view text, bool safe) {
  OutputFile file;
  file.create(path, text, true);
  if (safe) file.sync();
  file.close();
}

}  // namespace LSM::files
