// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_collector.h
/// Collects the earthquakes from the lines or elements of a file.
#ifndef LSM_POSTPROC_EVENT_COLLECTOR_H
#define LSM_POSTPROC_EVENT_COLLECTOR_H

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "earthquakes.h"
#include "event_record.h"

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

}  // namespace LSM::postproc

#endif
