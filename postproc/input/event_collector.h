// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_collector.h
/// Readers of the formats of earthquakes, and what collects the events from their lines or
/// elements.
#ifndef LSM_POSTPROC_EVENT_COLLECTOR_H
#define LSM_POSTPROC_EVENT_COLLECTOR_H

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "earthquakes.h"
#include "event_record.h"
#include "files/input_bytes.h"

namespace LSM::postproc {

class Collector {
 public:
  Collector(std::string path, bool lenient) : path_(std::move(path)), lenient_(lenient) {}

  /// Adds an event, or counts it if it is no earthquake or has no origin or magnitude.
  void add(const Record &record, std::int64_t line);
  /// Counts an event of which the file lacks the preferred origin or magnitude.
  void add_unpreferred() { ++list_.not_preferred; }

  const std::string &path() const { return path_; }
  /// What messages count, if not lines.
  void count_in(std::string_view unit) { unit_ = unit; }
  [[noreturn]] void fail(std::int64_t line, const std::string &what) const;
  /// Handles a line that cannot be read: counts it if lenient.
  /// \throws FileError otherwise
  void bad(std::int64_t line, const std::string &what);

  /// \throws FileError if most events are no earthquakes, unless lenient
  EarthquakeList finish();

 private:
  std::string where(std::int64_t number) const;
  void leave_out_fillers();

  std::string path_;
  std::string_view unit_;
  bool lenient_;
  EarthquakeList list_;
  std::int64_t zeros_with_others_ = 0;  ///< magnitudes of 0 beside others of the same event
};

/// Reads columns with names.
void read_columns(std::string_view content, Collector &out);

/// Columns: date, time of day, type of event, geographic type (not in the yearly files of 2003),
/// magnitude, its type, latitude, longitude, ... The type 'n' says that there is no magnitude.
void read_scedc(std::string_view content, Collector &out);

/// Columns: longitude, latitude, year, month, day, magnitude, depth, hour, minute[, second], and
/// others that are not used; NaN for what is missing.
void read_zmap(std::string_view content, Collector &out);

/// A collection of GeoJSON as ComCat writes it: times in milliseconds since 1970, places as
/// coordinates. The names of properties are those of columns.
void read_geojson(std::string_view content, Collector &out);

/// Reads the preferred origin and magnitude of each event in QuakeML, or the first ones. A file may
/// be of any length, and several documents, one after the other.
/// \throws FileError
void read_quakeml(files::Bytes &bytes, Collector &out);

}  // namespace LSM::postproc

#endif
