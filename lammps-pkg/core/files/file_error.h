// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/file_error.h
/// What readers and writers of files throw.
#ifndef LSM_FILE_ERROR_H
#define LSM_FILE_ERROR_H

#include <stdexcept>

namespace LSM {

/// A file cannot be read or written. The message is one line and names the file.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace LSM

#endif
