// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/restart_info.h
/// FILE.info beside a restart file holds the settings of the run, and size and checksum, so that an
/// incomplete file is recognized before anything reads it.
///
///   key = value                  one line each
///   lines = CRC                  of the lines above
///   CRC SIZE NAME                of the restart file, as cksum prints it in its folder
#ifndef LSM_RESTART_INFO_H
#define LSM_RESTART_INFO_H

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/parameters.h"

namespace LSM {

/// The checksum of POSIX cksum: CRC of the bytes and of their number.
class Cksum {
 public:
  explicit Cksum(std::string_view bytes = {}) { add(bytes); }
  void add(std::string_view bytes);
  std::uint64_t size() const { return size_; }
  std::uint32_t value() const;

 private:
  void push(unsigned char byte);
  static const std::array<std::uint32_t, 256> &table();

  std::uint32_t remainder_ = 0;
  std::uint64_t size_ = 0;
};

/// Renames the restart file `written` to `path` and writes its FILE.info with the settings, whose
/// keys must not contain '='. Whenever this is interrupted, a restart file that has an info file is
/// complete.
/// \throws FileError
void seal_restart(const std::string &written, const std::string &path,
                  const text_io::Parameters &settings);

/// Compares a restart file with its FILE.info and returns the settings in it, which are empty if
/// the info file has only its last line.
/// \throws FileError with the reason in one line
text_io::Parameters check_restart(const std::string &path);

}  // namespace LSM

#endif
