// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/line_reader.h"

#include <cstring>
#include <utility>

#include "files/file_error.h"

namespace LSM::files {

LineReader::LineReader(std::unique_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
  buffer_.resize(first_size);
  constexpr std::string_view mark = "\xef\xbb\xbf";
  const std::string_view begin = bytes_->peek(mark.size());
  if (is_utf16(begin)) throw FileError(path() + utf16_text);
  foreign_ = begin == mark;
  if (foreign_) end_ = static_cast<std::int64_t>(bytes_->read(buffer_.data(), mark.size()));
}

bool LineReader::next(std::string_view &line) {
  begin_ = end_;
  std::size_t searched = 0;
  const char *newline = nullptr;
  for (;;) {
    const char *const start = buffer_.data() + used_;
    const std::size_t there = filled_ - used_;
    newline = static_cast<const char *>(std::memchr(start + searched, '\n', there - searched));
    searched = there;
    if (newline || !fill()) break;
  }
  const char *const start = buffer_.data() + used_;
  const std::size_t length = newline ? static_cast<std::size_t>(newline - start) : searched;
  if (!newline && length == 0) return false;
  line = std::string_view(start, length);
  complete_ = newline != nullptr;
  const std::size_t taken = length + (complete_ ? 1 : 0);
  used_ += taken;
  end_ += static_cast<std::int64_t>(taken);
  ++line_;
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
    foreign_ = true;
  }
  return true;
}

void LineReader::fail(const std::string &what) const {
  throw FileError(text::where(path(), line_) + what);
}

bool LineReader::fill() {
  const std::size_t rest = filled_ - used_;
  std::memmove(buffer_.data(), buffer_.data() + used_, rest);
  used_ = 0;
  filled_ = rest;
  if (rest == buffer_.size()) {
    if (rest >= longest_line)
      throw FileError(text::where(path(), line_ + 1) + "longer than " +
                      std::to_string(longest_line) + " bytes, expected a line of text");
    buffer_.resize(2 * rest);
  }
  const std::size_t got = bytes_->read(buffer_.data() + filled_, buffer_.size() - filled_);
  filled_ += got;
  return got > 0;
}

}  // namespace LSM::files
