// SPDX-License-Identifier: GPL-2.0-or-later
/// \file run_files.h
/// Other files of the run that wrote a catalogue: PE series, ruptures, slip history.
#ifndef LSM_POSTPROC_RUN_FILES_H
#define LSM_POSTPROC_RUN_FILES_H

#include <string>
#include <vector>

#include "event_table.h"
#include "files/file_error.h"
#include "files/parameters.h"
#include "option_group.h"

namespace LSM::postproc {

/// The parameters in the header of a file.
struct HeaderOf {
  std::string path;
  files::Parameters parameters;
};
/// Checks that two files are from the same run, as files with the same prefix may not be. Settings
/// of what is recorded may differ.
/// \throws FileError if another setting that is in both headers differs
void check_same_run(const HeaderOf &one, const HeaderOf &other);
HeaderOf header_of(const EventTable &table);

/// Option for files of one kind, one per catalogue. By default, files beside the catalogues are
/// used.
class RunFiles {
 public:
  static RunFiles series() { return {"--series", "PE series of the run", ".pe.bin"}; }
  static RunFiles ruptures() {
    return {"--ruptures", "Catalogue of the ruptures of the run", ".ruptures.csv"};
  }
  static RunFiles moment_rates() {
    return {"--moment-rates", "Moment rates of the ruptures, of python3 -m lsm.sources",
            "-moment-rates.csv"};
  }
  static RunFiles history() { return {"--history", "Slip history of the run", ".slip.bin"}; }

  void add_to(CLI::App *command);
  /// Returns a path for each catalogue, "" if it has no such file.
  /// \throws std::invalid_argument unless the option was given once per catalogue, or not at all
  std::vector<std::string> of(const std::vector<std::string> &catalogues) const;
  bool given() const { return !given_.empty(); }

 private:
  RunFiles(const char *option, const char *what, const char *ending)
      : option_(option), what_(what), ending_(ending) {}

  const char *option_, *what_, *ending_;
  std::vector<std::string> given_;
};

}  // namespace LSM::postproc

#endif
