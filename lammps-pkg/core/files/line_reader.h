// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/line_reader.h
/// Lines of a text file.
#ifndef LSM_LINE_READER_H
#define LSM_LINE_READER_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_bytes.h"
#include "files/text.h"

namespace LSM::files {

/// Reads the lines of a file with their numbers and byte offsets, in large blocks. A byte order
/// mark and the '\r' of Windows line ends are removed.
class LineReader {
 public:
  /// \throws FileError
  explicit LineReader(const std::string &path) : LineReader(open_plain(path)) {}
  explicit LineReader(std::unique_ptr<Bytes> bytes);

  /// Returns the next line without its '\n', valid until the next call, or false at the end of the
  /// file.
  /// \throws FileError if the file cannot be read or a line is longer than any of ours can be.
  bool next(std::string_view &line);

  const std::string &path() const { return bytes_->path(); }
  std::int64_t line() const { return line_; }    ///< number of the last line, from 1
  std::int64_t begin() const { return begin_; }  ///< offset of the last line
  std::int64_t end() const { return end_; }      ///< offset behind the last line
  bool complete() const { return complete_; }    ///< the last line ended with '\n'
  /// Whether there was a byte order mark or a Windows line end, which none of our programs write.
  bool foreign() const { return foreign_; }

  [[noreturn]] void fail(const std::string &what) const;

 private:
  static constexpr std::size_t first_size = 1 << 18, longest_line = 1 << 20;

  /// Moves the unfinished line to the front and reads more bytes behind it. Returns false at the
  /// end of the file.
  bool fill();

  std::unique_ptr<Bytes> bytes_;
  std::vector<char> buffer_;
  std::size_t used_ = 0, filled_ = 0;  // the bytes not yet returned are between them
  std::int64_t line_ = 0, begin_ = 0, end_ = 0;
  bool complete_ = true, foreign_ = false;
};
}  // namespace LSM::files

#endif
