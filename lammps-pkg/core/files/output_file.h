// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/output_file.h
/// Output files that never lose what was written before.
#ifndef LSM_OUTPUT_FILE_H
#define LSM_OUTPUT_FILE_H

#include <unistd.h>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

namespace LSM::files {

/// Whether path is a regular file that is not empty.
bool holds_data(const std::string &path);

/// Returns why OutputFile could not write this file, or "". Changes nothing and leaves nothing
/// behind.
std::string why_not_writable(const std::string &path);

/// Describes why `opened`, which is path or a temporary file beside it, could not be opened.
std::string why_not_opened(const std::string &path, const std::string &opened, int reason);

/// Writes all data of a file, or all names of a folder, to the disk.
/// \throws FileError
void sync(const std::string &path);

/// Unbuffered output file: each write() hands all its bytes to the operating system at once, so
/// that a process killed between two calls leaves nothing half-written.
/// \throws FileError
class OutputFile {
 public:
  OutputFile() = default;
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;
  ~OutputFile() { discard(); }

  /// Replaces path by a file that begins with text, written beside it; an older file stays
  /// untouched if that fails.
  /// \param whole the file gets its name only by close(), without which nothing is left of it
  void create(const std::string &path, std::string_view text, bool whole = false);

  /// Selects an existing file, of which append() will keep this many bytes.
  void keep(const std::string &path, std::int64_t bytes);

  /// Truncates the file selected by keep() and continues behind the bytes that are kept.
  void append();

  /// As append(), with another header in place of the first `old` bytes. If they differ, a new file
  /// replaces the old one once it is complete.
  void append(std::string_view header, std::int64_t old);

  /// On failure the file is closed, as lines after a half-written one would not be readable.
  void write(std::string_view text);

  /// Waits until everything written is on the disk.
  void sync();
  void close();

  bool is_open() const { return file_ != nullptr; }
  const std::string &path() const { return path_; }

 private:
  static std::error_code reason() { return {errno, std::generic_category()}; }

  void take_name();
  [[noreturn]] void give_up(const char *what, std::error_code why = reason());

  void discard();
  void open(const std::string &shown, const std::string &opened, bool anew);

  std::FILE *file_ = nullptr;
  std::string path_, name_, written_;  // as given, with links resolved, and while being written
  std::uintmax_t kept_ = 0;
};

/// A file that a restarted run continues. find_cut() of the derived class only inspects it, so that
/// a run with several files truncates none of them before all are found to match.
class ResumableFile {
 public:
  /// Truncates the file where find_cut() found that the new run begins.
  /// \throws FileError
  void cut() { file_.append(); }
  /// As cut(), and the header becomes that of the new run: what may change (header_keys.h) gets its
  /// new value.
  /// \throws FileError
  void cut_with_new_header() { file_.append(header_, old_header_); }
  /// Closes the file. The destructor does this, too, but ignores errors.
  /// \throws FileError if the system reports a late failure
  void close() { file_.close(); }
  bool is_open() const { return file_.is_open(); }

 protected:
  [[noreturn]] static void refuse(const std::string &path, const std::string &why);

  OutputFile file_;
  std::string header_;           // of the new run
  std::int64_t old_header_ = 0;  // length of the header in the file
};

/// Replaces path by a file with the text, or leaves it unchanged.
/// \param safe also writes it to the disk, so that a power failure cannot lose it
/// \throws FileError
void write_file(const std::string &path, std::string_view text, bool safe = false);
}  // namespace LSM::files

#endif
