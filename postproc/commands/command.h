// SPDX-License-Identifier: GPL-2.0-or-later
/// \file command.h
/// The commands of postproc. To add one, define make_NAME() in a file of its own and add a line to
/// command_list.def.
#ifndef LSM_POSTPROC_COMMAND_H
#define LSM_POSTPROC_COMMAND_H

#include <memory>
#include <string>
#include <vector>

#include "catalogue_options.h"
#include "results.h"

namespace LSM::postproc {

/// A command of the program.
class Command {
 public:
  virtual ~Command() = default;
  /// Returns the text for --help.
  virtual const char *help() const = 0;
  /// Adds the options of this command and those that all commands have.
  void add_all_options(CLI::App *command);
  /// Runs the command.
  /// \throws std::exception with one clear line
  virtual void run() = 0;

 protected:
  bool overwrite = false;  ///< also replace files not from an earlier run of this command

  virtual void add_options(CLI::App *command) = 0;
};

/// A command that computes results from its inputs. All results are complete, and all outputs
/// checked, before the first is printed or written.
class Analysis : public Command {
 public:
  void run() final;

 protected:
  JsonOutput json;
  PictureOptions picture;

  std::string file_;  ///< which find() writes itself, see WrittenFile

  /// Adds --output for that file.
  void add_file(OptionGroup group, const std::string &help) {
    group.add("-o,--output", file_, help, required());
  }
  /// Adds --output, with a default, and --no-picture.
  void add_picture(CLI::App *command, const std::string &base);
  /// Adds --output, with a default, to a command that draws nothing.
  void add_table(OptionGroup group, const std::string &base);

  /// Files that the command reads.
  virtual std::vector<std::string> inputs() const = 0;
  /// Endings of the files that the results may have, besides those of the figure BASE.
  virtual std::vector<std::string> endings() const { return {}; }
  /// Reads the inputs and computes the results.
  virtual Results find() = 0;

 private:
  bool has_base_ = false;  ///< false: results go to no file but that of --json
};

/// A command that reads catalogues.
class CatalogueAnalysis : public Analysis {
 protected:
  CatalogueOptions catalogues;
  std::vector<std::string> inputs() const override { return catalogues.paths; }
};

/// A statistic of catalogues.
class Statistic : public CatalogueAnalysis {
 protected:
  /// Computes the results from catalogues.
  /// \throws std::exception
  virtual Results of(const std::vector<EventTable> &tables) = 0;
  /// Adds catalogues, --json, --output (with a default) and --no-picture.
  void add_usual(CLI::App *command, const std::string &base);
  Results find() override { return of(load_catalogues(catalogues)); }
};

/// Creates all commands, with their names, in the order of --help.
std::vector<std::pair<std::string, std::shared_ptr<Command>>> all_commands();

}  // namespace LSM::postproc

#endif
