// SPDX-License-Identifier: GPL-2.0-or-later
/// \file new_file.h
/// Output that appears whole or not at all.
#ifndef LSM_POSTPROC_NEW_FILE_H
#define LSM_POSTPROC_NEW_FILE_H

#include <string>

namespace LSM::postproc {

/// A file on its way: written under part(), it gets its name by commit(). Without that, after an
/// error, the destructor removes it and an older file of the name is as it was.
class NewFile {
 public:
  /// Missing folders are made. \throws FileError if path exists, unless force, or is no plain file.
  NewFile(const std::string &path, bool force);
  ~NewFile();
  NewFile(const NewFile &) = delete;
  NewFile &operator=(const NewFile &) = delete;

  const std::string &part() const { return part_; }
  /// Call when part() is closed. \throws FileError
  void commit();

 private:
  std::string path_, part_;
};

}  // namespace LSM::postproc

#endif
