// SPDX-License-Identifier: GPL-2.0-or-later
#include "new_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "files/file_error.h"
#include "files/output_file.h"

namespace LSM::postproc {

namespace fs = std::filesystem;

FileLock claim_output(const std::string &path, bool overwrite) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (path.empty()) throw FileError("the name of an output is empty, expected that of a file");
  if (fs::is_directory(status) || !fs::path(path).has_filename())
    throw FileError(path + ": is a directory, expected a file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  check_replaced(path, overwrite);
  const fs::path folder = fs::path(path).parent_path();
  code.clear();
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code) throw FileError(folder.string() + ": cannot make the folder: " + code.message());
  return FileLock(path);
}

void check_replaced(const std::string &path, bool overwrite, const Known &known) {
  const std::string problem = overwrite ? std::string() : why_kept(path, known);
  if (!problem.empty()) throw FileError(problem);
}

void check_output(const std::string &path, bool overwrite, const Known &known) {
  check_replaced(path, overwrite, known);
  std::error_code code;
  const fs::path folder = fs::absolute(path, code).parent_path();
  if (fs::exists(folder, code)) {
    const FileLock lock = claim_output(path, true);
    const std::string problem = files::why_not_writable(path);
    if (!problem.empty()) throw FileError(problem);
    return;
  }
  fs::path there = folder;  // becomes the existing folder in which the others will be created
  while (!there.empty() && !fs::exists(there, code)) there = there.parent_path();
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw FileError(folder.string() +
                    ": cannot make the folder: " + std::generic_category().message(errno));
}

void write_file(const std::string &path, std::string_view text) {
  const FileLock lock = claim_output(path, true);
  files::write_file(path, text);
}

void refuse_input(const std::string &output, const std::vector<std::string> &inputs) {
  std::error_code ignored;
  for (const std::string &input : inputs)
    if (fs::equivalent(output, input, ignored) || fs::equivalent(output + ".new", input, ignored))
      throw FileError(output + ": is read by this command, expected another name for the output");
}

void check_outputs(const std::vector<Output> &outputs, const std::vector<std::string> &inputs) {
  const std::string problem = bad_outputs(outputs);
  if (!problem.empty()) throw FileError(problem);
  for (const Output &output : outputs)
    if (!output.path.empty()) refuse_input(output.path, inputs);
}

}  // namespace LSM::postproc
