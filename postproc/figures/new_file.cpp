// SPDX-License-Identifier: GPL-2.0-or-later
#include "new_file.h"

#include <filesystem>
#include <system_error>

#include "lsm_text_io.h"

namespace LSM::postproc {

namespace fs = std::filesystem;

NewFile::NewFile(const std::string &path, bool replace) : path_(path), part_(path + ".part") {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status) || !fs::path(path).has_filename())
    throw FileError(path + ": is a directory, expected a file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    part_ = path_;
    return;
  }
  if (fs::exists(status)) {
    if (!replace)
      throw FileError(path + ": exists already, expected a new name or --force to replace it");
    // What a link points to is replaced, not the link.
    path_ = fs::canonical(path).string();
    part_ = path_ + ".part";
  }
  const fs::path folder = fs::path(path_).parent_path();
  code.clear();
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code) throw FileError(folder.string() + ": cannot make the folder: " + code.message());
  lock_ = FileLock(path_);
}

NewFile::~NewFile() {
  std::error_code ignored;
  if (part_ != path_) fs::remove(part_, ignored);
}

void NewFile::commit() {
  std::error_code code;
  if (part_ != path_) fs::rename(part_, path_, code);
  if (code) throw FileError(path_ + ": cannot write: " + code.message());
}

void write_file(const std::string &path, std::string_view text) {
  NewFile file(path, true);
  text_io::OutputFile<FileError> out;
  out.create(file.part(), text);
  out.close();
  file.commit();
}

void refuse_input(const std::string &output, const std::vector<std::string> &inputs) {
  std::error_code ignored;
  for (const std::string &input : inputs)
    if (fs::equivalent(output, input, ignored) ||
        fs::equivalent(output + ".part", input, ignored) ||
        fs::equivalent(output + ".lock", input, ignored))
      throw FileError(output + ": is read by this command, expected another name for the output");
}

void check_outputs(const std::vector<Output> &outputs, const std::vector<std::string> &inputs) {
  const std::string problem = bad_outputs(outputs);
  if (!problem.empty()) throw FileError(problem);
  for (const Output &output : outputs)
    if (!output.path.empty()) refuse_input(output.path, inputs);
}

}  // namespace LSM::postproc
