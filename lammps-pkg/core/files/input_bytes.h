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

namespace LSM::text_io {

/// The bytes of a file, in order.
class Bytes {
 public:
  explicit Bytes(std::string path) : path_(std::move(path)) {}
  virtual ~Bytes() = default;
  Bytes(const Bytes &) = delete;
  Bytes &operator=(const Bytes &) = delete;

  /// Returns fewer than most only at the end. \throws FileError
  std::size_t read(char *to, std::size_t most);
  /// The next bytes, without consuming them. \throws FileError
  std::string_view peek(std::size_t count);
  /// Of the whole file; negative: not known, of a pipe. \throws FileError
  virtual std::int64_t size() const = 0;
  const std::string &path() const { return path_; }

 private:
  virtual std::size_t more(char *to, std::size_t most) = 0;

  std::string path_, ahead_;
};

/// The bytes of a file, unchanged.
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

/// The program that compressed a file that begins with these bytes, or "".
std::string_view compressed_by(std::string_view head);
/// The same of a file that was not read yet. \throws FileError
std::string_view compressed_by(Bytes &file);

/// A file that is not compressed: LAMMPS and the block-slider link no library for others.
/// \throws FileError
std::unique_ptr<Bytes> open_plain(const std::string &path);

/// Whether a text begins as one in UTF-16, and what is to be said of it.
bool is_utf16(std::string_view head);
constexpr const char *utf16_text = ": text in UTF-16, expected UTF-8 or ASCII";
}  // namespace LSM::text_io

#endif
