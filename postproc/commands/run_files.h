// SPDX-License-Identifier: GPL-2.0-or-later
/// \file run_files.h
/// The other files of the run that wrote a catalogue.
#ifndef LSM_POSTPROC_RUN_FILES_H
#define LSM_POSTPROC_RUN_FILES_H

#include <string>
#include <vector>

#include "event_table.h"
#include "files/file_error.h"
#include "files/parameters.h"
#include "options.h"

namespace LSM::postproc {

/// The header of a file.
struct HeaderOf {
  std::string path;
  text_io::Parameters parameters;
};
/// \throws FileError if a setting of the run that both headers state is not the same: files of one
/// prefix may be of different runs. Settings of what is recorded may differ.
void check_same_run(const HeaderOf &one, const HeaderOf &other);
/// The same where `other` may be of the run of any of the catalogues.
void check_same_run(const std::vector<EventTable> &catalogues, const HeaderOf &other);

HeaderOf header_of(const EventTable &table);

/// Files of one kind, one for each catalogue: those given, or those that lie beside the catalogues.
class RunFiles {
 public:
  static RunFiles series() { return {"--series", "PE series of the run", ".pe.bin"}; }
  static RunFiles ruptures() {
    return {"--ruptures", "Catalogue of the ruptures of the run", ".ruptures.csv"};
  }
  static RunFiles history() { return {"--history", "Slip history of the run", ".slip.bin"}; }

  void add_to(CLI::App *command);
  /// A path for each catalogue, "" for none. \throws std::invalid_argument unless there is one for
  /// each or none at all
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
