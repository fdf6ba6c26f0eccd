// SPDX-License-Identifier: GPL-2.0-or-later
/// \file event_record.h
/// What a line or an element of a file says of an event, as text.
#ifndef LSM_POSTPROC_EVENT_RECORD_H
#define LSM_POSTPROC_EVENT_RECORD_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace LSM::postproc {

using Fields = std::vector<std::string>;

std::string in_small_letters(std::string_view text);

/// Whether a text stands for a value that is missing.
bool is_missing(std::string_view text);

/// What files may hold of an event.
enum class Field {
  latitude,
  longitude,
  magnitude,
  type,
  depth,
  number_of_fields  // not a field
};
constexpr auto number_of_fields = static_cast<std::size_t>(Field::number_of_fields);

/// One event as in the file, with empty texts for what the file does not have.
struct Record {
  std::array<std::string, number_of_fields> texts = {};
  std::string time = {};          ///< its texts, for messages
  std::optional<double> at = {};  ///< days since 1970, unless the time cannot be read
  std::string problem = {};       ///< what was expected instead of such a time, if known
  double depth_per_km = 1.0;
  bool has_origin = true;        ///< whether there is any time and place
  double other_magnitude = 0.0;  ///< the largest of the event's other magnitudes

  std::string &operator[](Field field) { return texts[static_cast<std::size_t>(field)]; }
  const std::string &operator[](Field field) const {
    return texts[static_cast<std::size_t>(field)];
  }
};

/// Splits a line at blanks, tabs and commas.
Fields split_blanks(std::string_view line);

/// Position of each field among names of columns or properties; -1: missing.
struct Places : std::array<std::ptrdiff_t, number_of_fields> {
  std::vector<std::size_t> other_magnitudes = {};  ///< and those of magnitudes that are no field
};
Places places_in(const Fields &names);

/// The record whose values, in the order of the names, are these.
Record record_of(const Fields &values, const Places &places);

}  // namespace LSM::postproc

#endif
