// SPDX-License-Identifier: GPL-2.0-or-later
/// \file options.h
/// Options that several commands share.
#ifndef LSM_POSTPROC_OPTIONS_H
#define LSM_POSTPROC_OPTIONS_H

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "event_table.h"
#include "files/output_claim.h"
#include "option_group.h"
#include "size_figures.h"

namespace LSM::postproc {

/// Rule for an option that takes a size, or a magnitude such as M2.5 for size 10^(1.5 x 2.5).
Rule size_or_magnitude();

/// Parses "LO:HI" with LO < HI, numbers or magnitudes such as M2.5. An end that is left out is
/// -infinity or infinity.
/// \throws std::invalid_argument naming the option
Range parse_range(const std::string &option, std::string_view text);

/// Parses "SLOPE" or "SLOPE:LO:HI" of --guide.
/// \throws std::invalid_argument
PowerLine parse_guide(std::string_view text);

/// Option --json: a JSON object that holds each table under its name, as an array with an object
/// per row.
class JsonOutput {
 public:
  /// Adds --json. With "-" as the file, JSON goes to standard output, and the text of the command
  /// to standard error.
  void add_to(CLI::App *command);
  /// The file to be written. Its path is empty if there is none or JSON goes to standard output.
  Output output() const { return {"--json", path_ == "-" ? std::string() : path_}; }
  /// Checks whether the file may be written.
  /// \param found the results; nullptr before there are any
  /// \throws FileError if it would replace a file that is not JSON, unless overwrite; with results,
  /// also if that JSON has another first name, or the file cannot be written
  void check(bool overwrite, const nlohmann::ordered_json *found = nullptr) const;
  /// Writes the results, if --json was given.
  /// \throws FileError
  void write(const nlohmann::ordered_json &found) const;

 private:
  static std::string text_of(const nlohmann::ordered_json &found);

  std::string path_;
  int standard_output_ = -1;  ///< with "-": descriptor of the original standard output
};

}  // namespace LSM::postproc

#endif
