// SPDX-License-Identifier: GPL-2.0-or-later
/// \file input_file.h
/// Input of all commands, compressed by gzip or xz or not, as its first bytes tell, not
/// its name.
#ifndef LSM_POSTPROC_INPUT_FILE_H
#define LSM_POSTPROC_INPUT_FILE_H

#include <memory>
#include <string>

#include "lsm_text_io.h"

namespace LSM::postproc {

/// For CatalogueReader, PeSeriesReader, SlipHistoryReader and LineReader. Checksums of compressed
/// files are verified. \throws FileError, also while reading: a damaged or truncated file, or one
/// compressed by another program
std::unique_ptr<text_io::Bytes> open_input(const std::string &path);

}  // namespace LSM::postproc

#endif
