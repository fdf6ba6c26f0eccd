// SPDX-License-Identifier: GPL-2.0-or-later
/// \file lsm_binary_io.h
/// What the binary files have in common: 16 bytes that name the format, int64 length of the header,
/// the header of "# key = value" lines, then records of numbers; everything little-endian.
#ifndef LSM_BINARY_IO_H
#define LSM_BINARY_IO_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "lsm_text_io.h"

namespace LSM::binary_io {

constexpr std::int64_t longest_header = 1 << 20;

inline void append_bytes(std::string &out, std::uint64_t bits) {
  for (int i = 0; i < 8; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xff);
}

inline void append_bytes(std::string &out, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  append_bytes(out, bits);
}

inline void append_bytes(std::string &out, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int i = 0; i < 4; ++i) out += static_cast<char>((bits >> (8 * i)) & 0xff);
}

template <class Bits>
Bits bits_from_bytes(const char *bytes) {
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i)
    bits |= static_cast<Bits>(static_cast<Bits>(static_cast<unsigned char>(bytes[i])) << (8 * i));
  return bits;
}

inline std::int64_t step_from_bytes(const char *bytes) {
  return static_cast<std::int64_t>(bits_from_bytes<std::uint64_t>(bytes));
}

inline double double_from_bytes(const char *bytes) {
  const auto bits = bits_from_bytes<std::uint64_t>(bytes);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

inline float float_from_bytes(const char *bytes) {
  const auto bits = bits_from_bytes<std::uint32_t>(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// The beginning of a file: `magic` of 16 bytes and the header.
inline std::string header_bytes(std::string_view magic, const text_io::Parameters &parameters) {
  std::string text(magic);
  const std::string lines = text_io::header_text("", parameters).substr(1);
  append_bytes(text, static_cast<std::uint64_t>(lines.size()));
  return text + lines;
}

/// Header and size of a binary file.
struct Header {
  text_io::Parameters parameters;
  std::int64_t begin = 0;  ///< of the records
  std::int64_t size = 0;   ///< of the whole file
};

/// Reads the header of a file whose first 16 bytes were read. What comes next is behind it.
/// \throws Error naming the file
template <class Error>
Header read_header(text_io::Bytes &in) {
  const std::string &path = in.path();
  std::array<char, 8> bytes{};
  Header header;
  const bool whole = in.read(bytes.data(), bytes.size()) == bytes.size();
  const std::int64_t length = step_from_bytes(bytes.data());
  header.size = in.size();
  if (!whole || length < 0 || length > longest_header || 16 + 8 + length > header.size)
    throw Error(path + ": file ends within the binary header, expected its length and " +
                "'# key = value' lines");
  header.begin = 16 + 8 + length;
  std::string text(static_cast<std::size_t>(length), '\0');
  if (in.read(text.data(), text.size()) != text.size())
    throw Error(path + ": cannot read the binary header");
  std::string_view rest = text;
  text_io::ParameterList parameters;
  for (std::int64_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string problem = parameters.add_line(rest.substr(0, end));
    if (!problem.empty())
      throw Error(path + ": header line " + std::to_string(number) + ": " + problem);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  header.parameters = parameters.all();
  return header;
}

}  // namespace LSM::binary_io

#endif
