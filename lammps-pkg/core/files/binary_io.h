// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/binary_io.h
/// The common layout of binary files: 16 bytes that name the format, the int64 length of the
/// header, the header of "# key = value" lines, then records of numbers; everything is
/// little-endian.
#ifndef LSM_BINARY_IO_H
#define LSM_BINARY_IO_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/file_error.h"
#include "files/header_keys.h"
#include "files/input_bytes.h"
#include "files/output_file.h"
#include "files/parameters.h"
#include "files/text.h"

namespace LSM::binary_io {

/// Converts between the byte order of the machine and that of the file.
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

// Info, the header of a kind of files, is a FileHeader and has
//   magic                  the first 16 bytes of a file of version 1: a name, the version, a line
//   end versions, version(), set_version(), which is called before the rest is read what it is, for
//   messages visit(info, f)         calls f(name, number) for each number, in the order of the file
//   header()               all parameters
//   read(all parameters)   takes those that visit() leaves out; returns what is wrong, or ""
//   problem()              what is wrong with the numbers, or ""
//   record_bytes()

/// Returns the model and the numbers of a header as parameters.
template <class Info>
files::Parameters numbers_of(const Info &info) {
  files::Parameters all = {{"model", info.model}};
  Info::visit(info, [&all](const char *name, const auto &value) {
    all.emplace_back(name, text::number(value));
  });
  return all;
}

/// Reads the records of a file, which all have the same size. Anything unexpected throws, except
/// that a lenient reader drops a truncated last record, as a killed run leaves it.
template <class Info>
class RecordReader {
 public:
  const std::string &path() const { return in_->path(); }
  const Info &info() const { return info_; }
  std::int64_t records() const { return total_; }  ///< of a file, or at the end of a pipe
  bool torn() const { return torn_; }              ///< a truncated last record is dropped
  /// Offset behind the last record that was read.
  std::int64_t end() const { return begin_ + read_ * bytes_; }

 protected:
  /// \throws FileError if the file cannot be read or its header is not as it should be.
  RecordReader(std::unique_ptr<files::Bytes> in, bool lenient)
      : in_(std::move(in)), lenient_(lenient) {
    const std::string problem = interpret(read_header());
    if (!problem.empty()) throw FileError(in_->path() + ": " + problem);
    bytes_ = info_.record_bytes();
    const std::int64_t size = in_->size();
    if (size >= 0) end_after(size - begin_);
  }

  /// Returns the bytes of the next record, valid until the next call, or nullptr at the end.
  /// \throws FileError
  const char *next_record() {
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
  /// Throws a FileError that names the last record read.
  [[noreturn]] void fail(const std::string &what) const {
    throw FileError(in_->path() + ": record " + std::to_string(read_) + ": " + what);
  }

 private:
  /// Reads all parameters of the header.
  files::Parameters read_header() {
    const std::string &path = in_->path();
    std::array<char, 16> first{};
    const std::string_view found(first.data(), in_->read(first.data(), first.size()));
    constexpr std::string_view name = Info::magic.substr(0, 15), family = name.substr(0, 14);
    if (found.substr(0, family.size()) != family)
      throw FileError(path + ": not a " + Info::what + ", expected a file that begins with " +
                      text::in_quotes(name));
    const int version = found.size() == first.size() && found[15] == '\n' ? found[14] - '0' : 0;
    if (version < 1 || version > Info::versions)
      throw FileError(path + ": " + Info::what + " of another version, expected version 1" +
                      (Info::versions > 1 ? " to " + std::to_string(Info::versions) : ""));
    info_.set_version(version);
    std::array<char, 8> bytes{};
    const bool whole = in_->read(bytes.data(), bytes.size()) == bytes.size();
    const auto length = from_bytes<std::int64_t>(bytes.data());
    std::string text;
    if (whole && length >= 0 && length <= files::longest_header)
      text.resize(static_cast<std::size_t>(length));
    if (!whole || in_->read(text.data(), text.size()) != static_cast<std::uint64_t>(length))
      throw FileError(path + ": file ends within the binary header, expected its length and " +
                      "'# key = value' lines");
    begin_ = 16 + 8 + length;
    files::ParameterList parameters;
    const std::string problem = parameters.add_lines(text, bad_value);
    if (!problem.empty()) throw FileError(path + ": " + problem);
    return parameters.all();
  }

  /// Assigns the parameters to the members of info_. Returns what is wrong, or "".
  std::string interpret(const files::Parameters &all) {
    std::string problem = files::take(all, "model", info_.model);
    Info::visit(info_, [&](const char *name, auto &value) {
      if (problem.empty()) problem = files::take(all, name, value);
    });
    if (problem.empty()) problem = info_.read(all);
    if (!problem.empty()) return problem;
    const files::Parameters known = info_.header();
    for (const auto &parameter : all)
      if (!files::find(known, parameter.first)) info_.parameters.push_back(parameter);
    return info_.problem();
  }

  void end_after(std::int64_t bytes) {
    total_ = bytes / bytes_;
    torn_ = bytes % bytes_ != 0;
    if (torn_ && !lenient_)
      throw FileError(in_->path() + ": truncated record " + std::to_string(total_ + 1) +
                      " at the end, expected " + std::to_string(bytes_) + " bytes per record");
  }

  std::unique_ptr<files::Bytes> in_;
  Info info_;
  std::int64_t begin_ = 0, bytes_ = 1, total_ = INT64_MAX, read_ = 0;
  std::vector<char> block_;
  std::size_t used_ = 0;
  bool lenient_ = false, torn_ = false;
};

/// Starts or continues a file of records.
template <class Info>
class RecordWriter : public files::ResumableFile {
 protected:
  /// Starts a new file. An older one is replaced only once the header has been written.
  /// \throws FileError
  /// \throws std::invalid_argument for a header that could not be read back
  void begin(const std::string &path, const Info &info) {
    take(info);
    file_.create(path, header_);
  }

  /// Checks that the header is what begin() would write, except for what may change.
  /// \throws the same, naming the first parameter that differs
  void compare(const std::string &path, const Info &found, const Info &info) {
    const std::string problem = files::difference(found.header(), checked(info));
    if (!problem.empty()) refuse(path, problem);
    take(info);
  }

  Info info_;

 private:
  void take(const Info &info) {
    const std::string lines = files::lines_of(checked(info));
    header_ = Info::magic;
    header_[14] = static_cast<char>('0' + info.version());
    append_bytes(header_, static_cast<std::int64_t>(lines.size()));
    header_ += lines;
    info_ = info;
  }
  static files::Parameters checked(const Info &info) {
    const std::string problem = info.problem();
    if (!problem.empty())
      throw std::invalid_argument(std::string(Info::what) + " header: " + problem);
    files::check_parameters(info.header());
    return info.header();
  }
};

}  // namespace LSM::binary_io

#endif
