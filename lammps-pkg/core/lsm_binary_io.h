// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_binary_io.h
/// What the binary files have in common: 16 bytes that name the format, int64 length of the header,
/// the header of "# key = value" lines, then records of numbers; everything little-endian.
#ifndef LSM_BINARY_IO_H
#define LSM_BINARY_IO_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsm_text_io.h"

namespace LSM::binary_io {

constexpr std::int64_t longest_header = 1 << 20;

/// A number in the byte order of the machine, as bytes of the file or back.
template <class Bytes>
Bytes little_endian(Bytes bytes) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  std::reverse(bytes.begin(), bytes.end());
#endif
  return bytes;
}

template <class Number>
void append_bytes(std::string &out, Number value) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), &value, bytes.size());
  bytes = little_endian(bytes);
  out.append(bytes.data(), bytes.size());
}

template <class Number>
Number from_bytes(const char *from) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), from, bytes.size());
  bytes = little_endian(bytes);
  Number value{};
  std::memcpy(&value, bytes.data(), bytes.size());
  return value;
}

/// The beginning of a file: `magic` of 16 bytes and the header.
inline std::string header_bytes(std::string_view magic, const text_io::Parameters &parameters) {
  std::string text(magic);
  const std::string lines = text_io::header_text("", parameters).substr(1);
  append_bytes(text, static_cast<std::int64_t>(lines.size()));
  return text + lines;
}

/// Header and size of a binary file.
struct Header {
  text_io::Parameters parameters;
  std::int64_t begin = 0;  ///< of the records
  std::int64_t size = 0;   ///< of the whole file; negative: not known, of a pipe
};

/// Reads a file up to the end of its header. \param magic its first 16 bytes, the last two of them
/// the version \param what it is, for messages \throws FileError naming the file
inline Header read_header(text_io::Bytes &in, std::string_view magic, const std::string &what) {
  const std::string &path = in.path();
  std::array<char, 16> first{};
  const std::string_view found(first.data(), in.read(first.data(), first.size()));
  const std::string_view name = magic.substr(0, magic.size() - 1), family = name.substr(0, 14);
  if (found != magic)
    throw FileError(path + (found.substr(0, family.size()) == family
                                ? ": " + what + " of another version, expected version 1"
                                : ": not a " + what + ", expected a file that begins with " +
                                      text_io::in_quotes(name)));
  std::array<char, 8> bytes{};
  Header header;
  const bool whole = in.read(bytes.data(), bytes.size()) == bytes.size();
  const auto length = from_bytes<std::int64_t>(bytes.data());
  std::string text;
  if (whole && length >= 0 && length <= longest_header)
    text.resize(static_cast<std::size_t>(length));
  if (!whole || in.read(text.data(), text.size()) != static_cast<std::uint64_t>(length))
    throw FileError(path + ": file ends within the binary header, expected its length and " +
                    "'# key = value' lines");
  header.begin = 16 + 8 + length;
  header.size = in.size();
  text_io::ParameterList parameters;
  const std::string problem = parameters.add_lines(text);
  if (!problem.empty()) throw FileError(path + ": " + problem);
  header.parameters = parameters.all();
  return header;
}

/// The records of a file, all of one size, one after the other.
class Records {
 public:
  Records() = default;
  /// After the header. \throws FileError for a truncated last one, which lenient drops
  Records(std::unique_ptr<text_io::Bytes> in, const Header &header, std::int64_t record_bytes,
          bool lenient)
      : in_(std::move(in)), begin_(header.begin), bytes_(record_bytes), lenient_(lenient) {
    if (header.size >= 0) end_after(header.size - begin_);
  }

  /// The bytes of the next one, valid until the next call; nullptr: there is none. \throws
  /// FileError
  const char *next() {
    if (read_ != total_ && used_ == block_.size()) {
      const std::int64_t most = std::max<std::int64_t>(1, (1 << 16) / bytes_);
      block_.resize(static_cast<std::size_t>(std::min(most, total_ - read_) * bytes_));
      used_ = 0;
      const std::size_t got = in_->read(block_.data(), block_.size());
      if (got < block_.size()) end_after(read_ * bytes_ + static_cast<std::int64_t>(got));
    }
    if (read_ == total_) return nullptr;
    ++read_;
    const char *const record = block_.data() + used_;
    used_ += static_cast<std::size_t>(bytes_);
    return record;
  }
  /// About the last one read. \throws FileError
  [[noreturn]] void fail(const std::string &what) const {
    throw FileError(in_->path() + ": record " + std::to_string(read_) + ": " + what);
  }

  std::int64_t total() const { return total_; }  ///< of a file, or at the end of a pipe
  bool torn() const { return torn_; }
  /// Offset behind the last one read.
  std::int64_t end() const { return begin_ + read_ * bytes_; }

 private:
  void end_after(std::int64_t bytes) {
    total_ = bytes / bytes_;
    torn_ = bytes % bytes_ != 0;
    if (torn_ && !lenient_)
      throw FileError(in_->path() + ": truncated record " + std::to_string(total_ + 1) +
                      " at the end, expected " + std::to_string(bytes_) + " bytes per record");
  }

  std::unique_ptr<text_io::Bytes> in_;
  std::int64_t begin_ = 0, bytes_ = 1, total_ = INT64_MAX, read_ = 0;
  std::vector<char> block_;
  std::size_t used_ = 0;
  bool lenient_ = false, torn_ = false;
};

}  // namespace LSM::binary_io

#endif
