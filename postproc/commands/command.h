// SPDX-License-Identifier: GPL-2.0-or-later
/// \file command.h
/// The commands of postproc. A new one is a file that defines make_NAME() and a line of
/// command_list.def.
#ifndef LSM_POSTPROC_COMMAND_H
#define LSM_POSTPROC_COMMAND_H

#include <memory>
#include <string>
#include <vector>

#include "catalogue_input.h"
#include "results.h"
#include "options.h"

namespace LSM::postproc {

class Command {
 public:
  virtual ~Command() = default;
  virtual const char *help() const = 0;
  /// Options of all commands and its own.
  void add_all_options(CLI::App *command);
  /// Runs the command. \throws std::exception with one clear line
  virtual void run() = 0;

 protected:
  bool overwrite = false;  ///< replace files that are none of an earlier run of this command

  virtual void add_options(CLI::App *command) = 0;
};

/// A command that turns its inputs into results, which are complete before the first is printed or
/// written.
class Analysis : public Command {
 public:
  void run() final;

 protected:
  JsonOutput json;
  PictureOptions picture;

  /// Adds --output and --no-picture.
  void add_picture(CLI::App *command, const std::string &base);
  /// Adds --output of a command that draws nothing.
  void add_table(OptionGroup group, const std::string &base);

  virtual std::vector<std::string> inputs() const = 0;
  /// Endings of the files that find() may lead to, beside those of the picture BASE.
  virtual std::vector<std::string> endings() const { return {}; }
  /// Files of other options that find() writes itself, see WrittenFile.
  virtual std::vector<Output> outputs() const { return {}; }
  virtual Results find() = 0;

 private:
  bool has_base_ = false;  ///< if not, results go into no file but that of --json
};

/// A command that reads catalogues.
class CatalogueAnalysis : public Analysis {
 protected:
  CatalogueOptions catalogues;
  std::vector<std::string> inputs() const override { return catalogues.paths; }
};

/// A statistic of catalogues.
class Statistic : public CatalogueAnalysis {
 public:
  /// Its results from catalogues, also for the report. \throws std::exception
  virtual Results of(const std::vector<EventTable> &tables) = 0;
  /// Heading of its section in the report of each model; nullptr: none. Options have their values
  /// without a command line.
  virtual const char *heading() const { return nullptr; }

 protected:
  /// Adds catalogues, --json, --output with a default and --no-picture.
  void add_usual(CLI::App *command, const std::string &base);
  Results find() override { return of(load_catalogues(catalogues)); }
};

/// Endings of the files of further pictures.
std::vector<std::string> picture_files(const std::vector<std::string> &names);

/// All commands by their names, in the order of --help.
std::vector<std::pair<std::string, std::shared_ptr<Command>>> all_commands();

}  // namespace LSM::postproc

#endif
