// SPDX-License-Identifier: GPL-2.0-or-later
/// \file history_input.h
/// Slip histories as the commands use them.
#ifndef LSM_POSTPROC_HISTORY_INPUT_H
#define LSM_POSTPROC_HISTORY_INPUT_H

#include <string>

#include "lsm_slip_history.h"

namespace LSM::postproc {

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
