// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_time.h
/// The time of an event, from the texts of a file: which names mean which part of a time, and how a
/// time is composed of its parts.
#ifndef LSM_POSTPROC_EVENT_TIME_H
#define LSM_POSTPROC_EVENT_TIME_H

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "event_record.h"

namespace LSM::postproc {

/// Days since 1970-01-01T00:00 UTC of a date, and a time of day if there is one: 1994-01-17,
/// 1994-01-17T12:30:55.39Z, 1994/1/17 04:30:55-08:00, 17 Jan 1994, 19940117123055. A time without a
/// zone is UTC.
/// \return nothing if the text is not such a date, or may be more than one
std::optional<double> parse_date(std::string_view text);
/// \param problem why the text is no date, if it is not
std::optional<double> parse_date(std::string_view text, std::string &problem);

/// ISO 8601 date and time, rounded to minutes, of days since 1970: 1994-01-17T12:30Z
std::string date_text(double days);

/// Parts of a time from years to seconds; what is not known has no value.
struct TimeParts {
  enum Part { year, month, day, hour, minute, second, number_of_parts };
  std::array<std::optional<double>, number_of_parts> values = {};
  std::optional<int> ahead = {};  ///< of UTC, in minutes

  std::optional<double> &operator[](Part part) { return values[part]; }
  const std::optional<double> &operator[](Part part) const { return values[part]; }
};

/// How the texts of a column are to be taken that mean two things.
struct TimeStyle {
  enum class Dates { not_known, day_first, month_first, both } dates = Dates::not_known;
  /// Of 1446: hours and minutes, minutes and seconds after leading zeros that are missing, or, next
  /// to a year of 1446, a fraction of it.
  enum class Digits { not_known, hhmm, hhmmss, hours, year, both } digits = Digits::not_known;
};

/// The columns of a table (or the properties in GeoJSON) that belong to the time of an event. What
/// two of them hold must agree, and the time has the parts that any of them has.
class TimeColumns {
 public:
  TimeColumns() = default;
  explicit TimeColumns(const Fields &names);

  /// Whether the columns can give a date.
  bool has_date() const;
  /// Whether a column belongs to the time.
  bool uses(std::size_t column) const { return used_[column]; }
  /// Days since 1970 of a line.
  /// \param problem says why there is no time, if there is none
  std::optional<double> time_of(const Fields &values, std::string &problem);
  /// The texts of a line that belong to its time.
  std::string texts(const Fields &values) const;
  /// The first of them.
  std::string_view first_text(const Fields &values) const;
  /// Whether a text in the columns has a digit, as all times have.
  bool has_digits(const Fields &values) const;

  using UseLine = std::function<void(const Fields &)>;
  /// Passes all lines of the file to its argument: the style of texts follows from all of them.
  std::function<void(const UseLine &)> for_each_line;

 private:
  struct Column {
    std::size_t at;
    int role;
    std::string name;
    TimeStyle style;
    bool decided;
  };
  void decide(Column &column);
  const Column *column_of(int role) const;

  std::vector<Column> columns_;  ///< in the order in which they count
  std::vector<bool> used_;       ///< of all columns
};

}  // namespace LSM::postproc

#endif
