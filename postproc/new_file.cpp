// SPDX-License-Identifier: GPL-2.0-or-later
#include "new_file.h"

#include <filesystem>
#include <system_error>

#include "lsm_text_io.h"

namespace LSM::postproc {

namespace fs = std::filesystem;

NewFile::NewFile(const std::string &path, bool force) : path_(path), part_(path + ".part") {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status))
      throw FileError(path + ": is not a plain file, expected a file name for the output");
    if (!force)
      throw FileError(path + ": exists already, expected a new name or --force to replace it");
    // What a link points to is replaced, not the link.
    path_ = fs::canonical(path).string();
    part_ = path_ + ".part";
  }
  const fs::path folder = fs::path(path_).parent_path();
  code.clear();
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code) throw FileError(folder.string() + ": cannot make the folder: " + code.message());
}

NewFile::~NewFile() {
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void NewFile::commit() {
  std::error_code code;
  fs::rename(part_, path_, code);
  if (code) throw FileError(path_ + ": cannot write: " + code.message());
}

}  // namespace LSM::postproc
