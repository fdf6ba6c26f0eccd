// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/restart_info.h
/// FILE.info beside a restart file holds the settings of the run, and size and checksum, so that an
/// incomplete file is recognized before anything reads it.
///
///   key = value                  one line each
///   lines = CRC                  CRC-32 of the lines above
///   CRC SIZE NAME                CRC-32, size and name of the restart file
#ifndef LSM_RESTART_INFO_H
#define LSM_RESTART_INFO_H

#include <string>

#include "files/parameters.h"

namespace LSM {

/// Renames the restart file `written` to `path` and writes its FILE.info with the settings, whose
/// keys must not contain '='. Whenever this is interrupted, a restart file that has an info file is
/// complete.
/// \throws FileError
void seal_restart(const std::string &written, const std::string &path,
                  const files::Parameters &settings);

/// Compares a restart file with its FILE.info and returns the settings in it, which are empty if
/// the info file has only its last line.
/// \throws FileError with the reason in one line
files::Parameters check_restart(const std::string &path);

}  // namespace LSM

#endif
