// SPDX-License-Identifier: GPL-2.0-or-later
/// \file catalogue_input.h
/// Catalogues as the commands use them: the columns that count, and the options that choose events.
#ifndef LSM_POSTPROC_CATALOGUE_INPUT_H
#define LSM_POSTPROC_CATALOGUE_INPUT_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "earthquakes.h"
#include "event_table.h"
#include "lsm_catalogue.h"

namespace LSM::postproc {

/// Which catalogues to read, and which of their events.
struct CatalogueOptions {
  std::vector<std::string> paths;
  std::vector<std::string> labels;  ///< one per path, or none: labels are made from the headers
  bool lenient = false;             ///< repair what can be repaired, and say so
  double min_size = 0.0;            ///< events of smaller size are left out (energy)
  double from_time = -std::numeric_limits<double>::infinity();  ///< first t_start kept
  double to_time = std::numeric_limits<double>::infinity();     ///< first t_start left out
  double from_day = -std::numeric_limits<double>::infinity();   ///< the same of earthquakes
  double to_day = std::numeric_limits<double>::infinity();
  CatalogueFormat format = CatalogueFormat::detect;
  std::vector<std::string> regions;  ///< of earthquakes, "W/E/S/N"; a table for each, or one
  /// Times, from_time and to_time are those of the plates' way: model time times driving velocity.
  bool displacement = false;

  /// Adds the catalogue arguments and the options that choose events to a command.
  void add_to(CLI::App *command);
  /// Adds --displacement to a command that says nothing about the unit of its times.
  void add_displacement(CLI::App *command);

 private:
  void add_time(CLI::App *command, const char *option, double &time, double &day,
                const std::string &help);
};

/// Adds --threshold. \param what beside "smallest size of"
CLI::Option *add_threshold(CLI::App *command, Threshold &threshold, const std::string &what);
/// The same, given once or several times.
CLI::Option *add_thresholds(CLI::App *command, std::vector<double> &thresholds,
                            const std::string &what);

/// Gives each event of a catalogue that the options choose to use, which need not keep it; returns
/// the table without the columns. \throws FileError "file:line: what, expected ..."
EventTable read_events(const std::string &path, const CatalogueOptions &options,
                       const std::function<void(const Event &)> &use);

/// Reads one catalogue; of earthquakes those in the first region. \throws FileError
/// "file:line: what, expected ..."
EventTable load_catalogue(const std::string &path, const CatalogueOptions &options);

/// \throws std::invalid_argument for impossible times, sizes or numbers of labels.
void check(const CatalogueOptions &options);

/// What was repaired, on standard error.
void state_repairs(const EventTable &table);

/// Reads all options.paths, labels them, and states repairs on standard error.
/// \throws FileError; std::invalid_argument for impossible options.
std::vector<EventTable> load_catalogues(const CatalogueOptions &options);

}  // namespace LSM::postproc

#endif
