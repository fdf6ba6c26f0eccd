// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/restart_info.h
/// FILE.info beside a restart file: settings of the run, and size and checksum, by which an
/// incomplete file is recognized before anything reads it. (Ours.)
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

/// Gives a restart file, written as `written`, its name and its FILE.info. Whenever this is
/// interrupted, a file with an info is complete, and an older one of that name stays or is gone.
/// settings: keys without '='. \throws FileError
void seal_restart(const std::string &written, const std::string &path,
                  const text_io::Parameters &settings);

/// Compares a restart file with its FILE.info; returns the settings in it, which are empty if it
/// has only the last line. \throws FileError, one line with the reason
text_io::Parameters check_restart(const std::string &path);

}  // namespace LSM

#endif
