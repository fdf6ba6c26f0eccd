// SPDX-License-Identifier: GPL-2.0-or-later
/// \file catalogue_input.h
/// Catalogues as the commands read them, and the options that choose events.
#ifndef LSM_POSTPROC_CATALOGUE_INPUT_H
#define LSM_POSTPROC_CATALOGUE_INPUT_H

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "earthquakes.h"
#include "event_table.h"
#include "files/catalogue.h"
#include "options.h"

namespace LSM::postproc {

/// Which catalogues to read, and which of their events.
struct CatalogueOptions {
  std::vector<std::string> paths;
  std::vector<std::string> labels;  ///< one per path, or none: labels are made from the headers
  bool lenient = false;             ///< repair what can be repaired, with a message
  double min_size = 0.0;            ///< smaller events are omitted (energy)
  double from_time = -std::numeric_limits<double>::infinity();  ///< first t_start kept
  double to_time = std::numeric_limits<double>::infinity();     ///< first t_start omitted
  double from_day = -std::numeric_limits<double>::infinity();   ///< the same of earthquakes
  double to_day = std::numeric_limits<double>::infinity();
  /// Number of events, the largest (and equal ones), of which a table has all columns.
  std::size_t details = 0;
  static constexpr std::size_t all_events = std::numeric_limits<std::size_t>::max() / 2;
  std::string format = "detect";     ///< or models, csv, quakeml, zmap, scedc
  std::vector<std::string> regions;  ///< of earthquakes, "W/E/S/N"; a table for each, or one
  /// Times, from_time and to_time are displacements of the plates: model time times driving
  /// velocity.
  bool displacement = false;

  /// Adds the catalogue arguments and the options that choose events to a command.
  void add_to(CLI::App *command);
  /// Adds --displacement to a command that says nothing about the unit of its times.
  void add_displacement(CLI::App *command);
};

/// Adds --threshold. \param what beside "smallest size of"
void add_threshold(OptionGroup group, Threshold &threshold, const std::string &what);
/// The same, given once or several times.
void add_thresholds(OptionGroup group, std::vector<double> &thresholds, const std::string &what);

/// Changes a parameter of a header, or adds it at the end.
void set_parameter(text_io::Parameters &parameters, const std::string &key,
                   const std::string &value);

/// Gives each event of a catalogue that the options choose to use, which need not keep it; returns
/// the table without events. \param begin called with what is known before the first event
/// \throws FileError "file:line: what, expected ..."
using UseEvent = std::function<void(const Event &)>;
using UseTable = std::function<void(const EventTable &)>;
EventTable read_events(
    const std::string &path, const CatalogueOptions &options, const UseEvent &use,
    const UseTable &begin = [](const EventTable &) {});

/// Reads one catalogue; of earthquakes those in the first region. Events are in the order of the
/// file. \throws FileError "file:line: what, expected ..."
EventTable read_all(const std::string &path, const CatalogueOptions &options);
/// The same in order of the starts of events.
EventTable load_catalogue(const std::string &path, const CatalogueOptions &options);

/// \throws std::invalid_argument for impossible times, sizes or numbers of labels.
void check(const CatalogueOptions &options);

/// \throws std::invalid_argument if an option that chooses earthquakes is given without a catalogue
/// of them, or one that chooses events of models with nothing else
void check_kinds(const CatalogueOptions &options, std::size_t quakes, std::size_t all);

/// Calls use with each catalogue, one of earthquakes once for each region, which is the only one of
/// the options that it gets; use returns whether it is one of earthquakes.
/// \throws std::invalid_argument for impossible options, and at the end if one of them has chosen
/// nothing, as no catalogue is of its kind
using UseCatalogue = std::function<bool(const std::string &path, const CatalogueOptions &options)>;
void for_each_catalogue(const CatalogueOptions &options, const UseCatalogue &use);

/// Reports on standard error what was repaired.
void state_repairs(const EventTable &table);

/// Reads all options.paths, labels them, and states repairs on standard error.
/// \throws FileError; std::invalid_argument for impossible options.
std::vector<EventTable> load_catalogues(const CatalogueOptions &options);

}  // namespace LSM::postproc

#endif
