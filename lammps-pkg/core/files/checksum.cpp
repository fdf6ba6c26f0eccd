// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/checksum.h"

#include <zlib.h>

#include "files/input_bytes.h"

namespace LSM {

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef *>(bytes.data()), bytes.size()));
}

FileSum sum_of_file(const std::string &path) {
  files::FileBytes in(path);
  FileSum sum;
  std::string block(1 << 20, '\0');
  while (const std::size_t got = in.read(block.data(), block.size())) {
    sum.crc32 = crc32(std::string_view(block).substr(0, got), sum.crc32);
    sum.size += got;
  }
  return sum;
}

}  // namespace LSM
