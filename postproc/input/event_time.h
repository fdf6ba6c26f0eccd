// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_time.h
/// The time of an event from texts: dates and times of day as agencies write them.
#ifndef LSM_POSTPROC_EVENT_TIME_H
#define LSM_POSTPROC_EVENT_TIME_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace LSM::postproc {

/// Days since 1970-01-01T00:00 UTC of a date, and a time of day if there is one: 1994-01-17,
/// 1994-01-17T12:30:55.39Z, 1994/1/17 04:30:55-08:00, 17 Jan 1994, 19940117123055. A time without a
/// zone is UTC.
/// \return nothing if the text is not such a date, or may be more than one
std::optional<double> parse_date(std::string_view text);
/// \param problem why the text is no date, if that is known
std::optional<double> parse_date(std::string_view text, std::string &problem);

/// ISO 8601 date and time, rounded to minutes, of days since 1970: 1994-01-17T12:30Z
std::string date_text(double days);

/// Parts of a time; what is not known has no value.
struct TimeParts {
  enum Part { year, month, day, hour, minute, second, number_of_parts };
  std::array<std::optional<double>, number_of_parts> values = {};
  std::optional<double> ahead = {};  ///< of UTC, in minutes

  std::optional<double> &operator[](std::size_t part) { return values[part]; }
  const std::optional<double> &operator[](std::size_t part) const { return values[part]; }

  /// Adds parts from elsewhere.
  /// \return whether they agree with those that are known
  bool add(const TimeParts &others);
  /// Adds what a text says of the time zone: UTC, +09:00
  bool add_zone(std::string_view text, std::string &problem);
  /// Days since 1970; the parts without a value are 0. What is out of its unit carries over, as in
  /// 23:59:60.
  /// \return nothing, and a problem, if there is no such time, or if a part is missing and a
  /// smaller one is not
  std::optional<double> days(std::string &problem) const;
};

/// Days since 1970 of a year with a fraction.
double days_of_year(double year);

/// 1 to 12 of the English name of a month, which may be cut to three letters.
std::optional<double> month_of(std::string_view name);

/// How to read texts that mean two things, as all of a file say together.
class TimeStyle {
 public:
  /// Takes a name of a column: dd/mm/yyyy, Time(hhmmss.ss)
  void learn_name(std::string_view name);
  /// Takes a text that may be a date.
  void learn_date(std::string_view text);
  /// Takes a text that may be a time of day.
  /// \param year of the same line, if it is known
  void learn_clock(std::string_view text, std::optional<double> year);
  /// Whether a time of day is the year again, with a fraction: 2011.19034
  bool is_year() const { return digits_ > 0 && in_year_; }

  /// Reads a date, a time of day or both.
  /// \param needs_date whether a time of day alone is refused
  /// \return nothing if the text is none, with a problem if it is known
  std::optional<TimeParts> parse(std::string_view text, bool needs_date,
                                 std::string &problem) const;

 private:
  bool take_date(std::string_view &text, TimeParts &parts, std::string &problem) const;
  bool take_clock(std::string_view &text, bool after_date, TimeParts &parts,
                  std::string &problem) const;

  bool day_first_ = false, month_first_ = false;  // in 13/10/2022, 10/13/2022
  // Of times of day without colons: what they are, digits before the point, whether one has a
  // point.
  bool hhmm_ = false, hhmmss_ = false, fraction_ = false, in_year_ = true;
  std::size_t digits_ = 0;
};

}  // namespace LSM::postproc

#endif
