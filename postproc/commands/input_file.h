// SPDX-License-Identifier: GPL-2.0-or-later
/// \file input_file.h
/// Input of all commands, compressed by gzip or xz or not, as its first bytes tell, not
/// its name; and slip histories as the commands use them.
#ifndef LSM_POSTPROC_INPUT_FILE_H
#define LSM_POSTPROC_INPUT_FILE_H

#include <memory>
#include <string>

#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/slip_history.h"

namespace LSM::postproc {

/// For CatalogueReader, PeSeriesReader, SlipHistoryReader and LineReader. Checksums of compressed
/// files are verified. \throws FileError, also while reading: a damaged or truncated file, or one
/// compressed by another program
std::unique_ptr<text_io::Bytes> open_input(const std::string &path);

/// Opens a history and states a truncated last record on standard error (lenient).
/// \throws FileError; std::runtime_error without a driving velocity
SlipHistoryReader open_history(const std::string &path, bool lenient);

/// Names the file in what use throws about its records.
template <class Use>
auto with_path(const std::string &path, Use &&use) {
  try {
    return use();
  } catch (const FileError &) {
    throw;
  } catch (const std::runtime_error &error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace LSM::postproc

#endif
