// SPDX-License-Identifier: GPL-2.0-or-later
/// \file catalogue_input.h
/// How catalogues are read, and what of them.
#ifndef LSM_POSTPROC_CATALOGUE_INPUT_H
#define LSM_POSTPROC_CATALOGUE_INPUT_H

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "earthquakes.h"
#include "event_table.h"
#include "files/catalogue.h"

namespace LSM::postproc {

/// Which catalogues to read, and which of their events.
struct CatalogueOptions {
  std::vector<std::string> paths;
  std::vector<std::string> labels;  ///< one per path; empty: made from the headers
  bool lenient = false;             ///< skip and report lines that cannot be read
  double min_size = 0.0;            ///< smaller events are left out (energy)
  double from_time = -std::numeric_limits<double>::infinity();  ///< first t_start used
  double to_time = std::numeric_limits<double>::infinity();     ///< first t_start left out
  std::vector<std::string> where;                               ///< conditions on columns
  double from_day = -std::numeric_limits<double>::infinity();   ///< first day of earthquakes used
  double to_day = std::numeric_limits<double>::infinity();  ///< first day of earthquakes left out
  /// Number of the largest events whose columns are all kept; ties may make them a few more.
  std::size_t details = 0;
  std::string format = "detect";     ///< detect, models, csv, quakeml, zmap or scedc
  std::vector<std::string> regions;  ///< "W/E/S/N", for earthquakes; a table for each
  /// Whether times, from_time and to_time included, are displacements of the driving plate: model
  /// time times driving velocity.
  bool displacement = false;
  /// Bins of magnitudes, of width 0: none; without it those that are recognized.
  std::optional<MagnitudeBins> magnitude_bins;
};

/// An event as it is read.
struct ReadEvent : EventRow {
  const Earthquake *earthquake = nullptr;  ///< nullptr: of a model
};

/// Changes the value of a parameter, or adds the parameter at the end.
void set_parameter(files::Parameters &parameters, const std::string &key, const std::string &value);

/// Reads a catalogue of any size event by event, without keeping the events.
/// \param use called with each event that the options select
/// \param begin called before the first event, with the table as known by then
/// \return the table, without events
/// \throws FileError "file:line: what, expected ..."
using UseEvent = std::function<void(const ReadEvent &)>;
using UseTable = std::function<void(const EventTable &)>;
EventTable read_events(
    const std::string &path, const CatalogueOptions &options, const UseEvent &use,
    const UseTable &begin = [](const EventTable &) {});

/// Reads one catalogue; of earthquakes only those in the first region. Events are in the order of
/// the file.
/// \throws FileError "file:line: what, expected ..."
EventTable read_all(const std::string &path, const CatalogueOptions &options);
/// As read_all(), with the events in order of their starts.
EventTable load_catalogue(const std::string &path, const CatalogueOptions &options);

/// Checks that an option was given once for each of `count` things, or not at all.
/// \param of what the things are, for the message
/// \throws std::invalid_argument otherwise
void expect_each(const char *option, std::size_t given, const char *of, std::size_t count);

/// Checks the options before a catalogue is read.
/// \throws std::invalid_argument for impossible times, regions or numbers of labels
void check(const CatalogueOptions &options);

/// Checks that the options apply to the kinds of the catalogues that were read.
/// \param quakes number of catalogues of earthquakes, counted once per region
/// \param all number of all catalogues, counted likewise
/// \throws std::invalid_argument if an option for earthquakes is given without a catalogue of them,
/// one for models with catalogues of earthquakes only, or a wrong number of labels
void check_kinds(const CatalogueOptions &options, std::size_t quakes, std::size_t all);

/// Calls `use` for each catalogue, and for one of earthquakes once per region.
/// \param use gets the path and the options with that single region, and returns whether the
/// catalogue is one of earthquakes
/// \throws std::invalid_argument for impossible options, and at the end, see check_kinds(), for
/// options that no catalogue is of the kind for
using UseCatalogue = std::function<bool(const std::string &path, const CatalogueOptions &options)>;
void for_each_catalogue(const CatalogueOptions &options, const UseCatalogue &use);

/// Reports on standard error what was left out or repaired.
void state_repairs(const EventTable &table);

/// Reads and labels all catalogues in options.paths, and reports repairs on standard error.
/// \throws FileError
/// \throws std::invalid_argument for impossible options
std::vector<EventTable> load_catalogues(const CatalogueOptions &options);

}  // namespace LSM::postproc

#endif
