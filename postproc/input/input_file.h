// SPDX-License-Identifier: GPL-2.0-or-later
/// \file input_file.h
/// Input files of all commands, which may be compressed by gzip or xz (recognized by the first
/// bytes, not by the name), and slip histories as the commands open them.
#ifndef LSM_POSTPROC_INPUT_FILE_H
#define LSM_POSTPROC_INPUT_FILE_H

#include <memory>
#include <string>

#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/slip_history.h"

namespace LSM::postproc {

/// Opens a file for CatalogueReader, PeSeriesReader, SlipHistoryReader or LineReader. Checksums of
/// compressed files are verified.
/// \throws FileError if the file cannot be opened or is compressed by another program; while
/// reading, also if it is damaged or truncated
std::unique_ptr<files::Bytes> open_input(const std::string &path);

/// Opens a slip history.
/// \param lenient drop a truncated last record and report it on standard error
/// \throws FileError
/// \throws std::runtime_error if its header has no driving velocity
SlipHistoryReader open_history(const std::string &path, bool lenient);

}  // namespace LSM::postproc

#endif
