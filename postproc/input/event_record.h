// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_record.h
/// What a line or an element of a file says of an event, as text, and what columns mean.
#ifndef LSM_POSTPROC_EVENT_RECORD_H
#define LSM_POSTPROC_EVENT_RECORD_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "event_time.h"

namespace LSM::postproc {

using Fields = std::vector<std::string>;

std::string in_small_letters(std::string_view text);

/// Whether a text stands for a value that is missing.
bool is_missing(std::string_view text);

/// What files may hold of an event.
enum class Field { latitude, longitude, magnitude, type, number_of_fields };

/// One event as in the file, with empty texts for what the file does not have.
struct Record {
  std::array<std::string, static_cast<std::size_t>(Field::number_of_fields)> texts = {};
  std::string time = {};          ///< its texts, for messages
  std::optional<double> at = {};  ///< days since 1970, unless the time cannot be read
  std::string problem = {};       ///< what was expected instead of such a time, if known
  bool has_origin = true;         ///< whether there is any time and place
  double other_magnitude = 0.0;   ///< the largest of the event's other magnitudes

  std::string &operator[](Field field) { return texts[static_cast<std::size_t>(field)]; }
  const std::string &operator[](Field field) const {
    return texts[static_cast<std::size_t>(field)];
  }
};

/// Splits a line at blanks, tabs and commas.
Fields split_blanks(std::string_view line);

/// The columns of a table, or the properties in GeoJSON, by their names. What two of them hold of
/// the time must agree, and it has the parts that any of them has.
class Columns {
 public:
  Columns() = default;
  explicit Columns(const Fields &names);

  /// Names of what an event needs and the columns lack, out of 4.
  Fields missing() const;
  /// Whether a column counts.
  bool uses(std::size_t column) const { return roles_[column] != no_role; }
  /// Takes a line of the file: the style of times follows from all of them.
  void learn(const Fields &values);
  /// Whether a text of the time has a digit, as all times have.
  bool has_time(const Fields &values) const;
  /// The first text of the time.
  std::string_view first_time(const Fields &values) const;
  /// The event of a line.
  Record record_of(const Fields &values) const;

 private:
  static constexpr int no_role = -1;
  struct TimeColumn {
    std::size_t at;
    int role;
    std::string name;
  };
  std::string time_texts(const Fields &values) const;
  std::optional<double> time_of(const Fields &values, std::string &problem) const;
  bool has(int role) const;

  std::vector<int> roles_;         ///< of all columns
  std::vector<TimeColumn> times_;  ///< in the order in which they count
  TimeStyle style_;
};

}  // namespace LSM::postproc

#endif
