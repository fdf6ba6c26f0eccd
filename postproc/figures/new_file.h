// SPDX-License-Identifier: GPL-2.0-or-later
/// \file new_file.h
/// Output that appears whole or not at all, and never in the place of what it was made from.
#ifndef LSM_POSTPROC_NEW_FILE_H
#define LSM_POSTPROC_NEW_FILE_H

#include <string>
#include <string_view>
#include <vector>

#include "files/output_claim.h"
#include "files/replaced_file.h"

namespace LSM::postproc {

/// Before path is written: makes missing folders, and keeps others from writing it while the lock
/// is held. \throws FileError if path exists, unless overwrite, is a folder, or is being written by
/// another program of ours.
FileLock claim_output(const std::string &path, bool overwrite);

/// \throws FileError if a file is there that is not known as an earlier one of the same output,
/// unless overwrite
void check_replaced(const std::string &path, bool overwrite, const Known &known = nullptr);

/// The same, and nothing is in the way of writing path; to be asked of all outputs before the first
/// is written. \throws FileError
void check_output(const std::string &path, bool overwrite, const Known &known = nullptr);

/// A file that is written as one goes, and claimed as long.
template <class Writer>
struct ClaimedFile {
  ClaimedFile(const std::string &path, bool overwrite) : lock(claim_output(path, overwrite)) {}
  FileLock lock;
  Writer writer;
};

/// Writes text to path, in place of an older file, see check_replaced(). \throws FileError
void write_file(const std::string &path, std::string_view text);

/// \throws FileError if output, or its temporary name, is one of the files that are read.
void refuse_input(const std::string &output, const std::vector<std::string> &inputs);

/// The same for several outputs; empty paths are skipped. \throws FileError also if two of them
/// are one file, whatever its names
void check_outputs(const std::vector<Output> &outputs, const std::vector<std::string> &inputs);

}  // namespace LSM::postproc

#endif
