// SPDX-License-Identifier: GPL-2.0-or-later
/// \file new_file.h
/// Output files that appear whole or not at all, and never replace the input they were made from.
#ifndef LSM_POSTPROC_NEW_FILE_H
#define LSM_POSTPROC_NEW_FILE_H

#include <string>
#include <string_view>
#include <vector>

#include "files/output_claim.h"
#include "files/replaced_file.h"

namespace LSM::postproc {

/// Prepares to write path: creates missing folders, and locks the file against other programs of
/// this project. Devices and pipes are not locked.
/// \throws FileError if path exists (unless overwrite), is a folder, or is being written by another
/// program of this project
FileLock claim_output(const std::string &path, bool overwrite);

/// Refuses to replace a file unless `known` recognizes it as an earlier version of the same output.
/// \throws FileError if there is another file, unless overwrite
void check_replaced(const std::string &path, bool overwrite, const Known &known = nullptr);

/// As check_replaced(), and also checks that path can be written. Call it for all outputs before
/// the first one is written.
/// \throws FileError if path must not be replaced or cannot be written
void check_output(const std::string &path, bool overwrite, const Known &known = nullptr);

/// A writer of a file, with the lock of the file for as long as it is written.
template <class Writer>
struct ClaimedFile {
  ClaimedFile(const std::string &path, bool overwrite) : lock(claim_output(path, overwrite)) {}
  FileLock lock;
  Writer writer;
};

/// Writes text to path and replaces an older file, for which check_replaced() has to be called
/// before.
/// \throws FileError
void write_file(const std::string &path, std::string_view text);

/// Refuses an output that would replace an input.
/// \throws FileError if output or its temporary file is one of the inputs
void refuse_input(const std::string &output, const std::vector<std::string> &inputs);

/// As refuse_input(), for several outputs. Empty paths are skipped.
/// \throws FileError also if two outputs lead to the same file, under any names
void check_outputs(const std::vector<Output> &outputs, const std::vector<std::string> &inputs);

}  // namespace LSM::postproc

#endif
