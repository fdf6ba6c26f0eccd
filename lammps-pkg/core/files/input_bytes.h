// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/input_bytes.h
/// The bytes of an input file, and what they say about its format.
#ifndef LSM_INPUT_BYTES_H
#define LSM_INPUT_BYTES_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace LSM::files {

/// A stream of the bytes of a file.
class Bytes {
 public:
  explicit Bytes(std::string path) : path_(std::move(path)) {}
  virtual ~Bytes() = default;
  Bytes(const Bytes &) = delete;
  Bytes &operator=(const Bytes &) = delete;

  /// Reads up to `most` bytes, fewer only at the end of the file. Returns their number.
  /// \throws FileError
  std::size_t read(char *to, std::size_t most);
  /// Returns the next bytes without consuming them.
  /// \throws FileError
  std::string_view peek(std::size_t count);
  /// Size of the whole file, negative for a pipe, whose size is not known.
  /// \throws FileError
  virtual std::int64_t size() const = 0;
  const std::string &path() const { return path_; }

 private:
  virtual std::size_t more(char *to, std::size_t most) = 0;

  std::string path_, ahead_;
};

/// The bytes of a file as they are on disk.
class FileBytes : public Bytes {
 public:
  /// \throws FileError
  explicit FileBytes(const std::string &path);
  std::int64_t size() const override;

 private:
  struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };

  std::size_t more(char *to, std::size_t most) override;

  std::unique_ptr<std::FILE, Close> file_;
};

/// Names the program that compressed a file that begins with these bytes, or returns "".
std::string_view compressed_by(std::string_view head);
/// As above, for a file of which nothing has been read yet.
/// \throws FileError
std::string_view compressed_by(Bytes &file);

/// Opens a file that must not be compressed, as LAMMPS and the block-slider do not link a library
/// for decompression.
/// \throws FileError
std::unique_ptr<Bytes> open_plain(const std::string &path);

/// Whether a text begins as one of UTF-16, with or without a byte order mark.
bool is_utf16(std::string_view head);
constexpr const char *utf16_text = ": text in UTF-16, expected UTF-8 or ASCII";
}  // namespace LSM::files

#endif
