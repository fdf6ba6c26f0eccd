// SPDX-License-Identifier: GPL-2.0-or-later
/// \file json_output.h
/// Option --json of the commands that print numbers: the same numbers, for programs.
#ifndef LSM_POSTPROC_JSON_OUTPUT_H
#define LSM_POSTPROC_JSON_OUTPUT_H

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "lsm_output_claim.h"
#include "plot.h"

namespace LSM::postproc {

/// One JSON object: each table by its name, an array with an object for each row.
class JsonOutput {
 public:
  /// With "-" as the file, JSON is all there is on standard output: what the command says goes to
  /// standard error.
  void add_to(CLI::App *command);
  /// \throws FileError if the file is one of those that are read.
  void check(const std::vector<std::string> &inputs) const;
  /// For PictureOptions::check(); no path, if nothing is written.
  Output output() const { return {"--json", path_ == "-" ? std::string() : path_}; }
  void add(const std::string &name, const Table &table) { found_[name] = table.json(); }
  void add(const std::string &name, nlohmann::ordered_json value) {
    found_[name] = std::move(value);
  }
  /// Writes what was added, if --json was given. \throws FileError
  void write() const;

 private:
  std::string path_;
  int standard_output_ = -1;  ///< where it led before, with "-"
  nlohmann::ordered_json found_;
};

}  // namespace LSM::postproc

#endif
