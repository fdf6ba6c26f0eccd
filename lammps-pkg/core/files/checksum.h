// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/checksum.h
/// The checksum of all files: CRC-32, as in gzip and PNG.
#ifndef LSM_CHECKSUM_H
#define LSM_CHECKSUM_H

#include <cstdint>
#include <string>
#include <string_view>

namespace LSM {

/// CRC-32 of bytes that follow those with the given sum.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

struct FileSum {
  std::uint64_t size = 0;
  std::uint32_t crc32 = 0;
};
/// \throws FileError if the file cannot be read
FileSum sum_of_file(const std::string &path);

}  // namespace LSM

#endif
