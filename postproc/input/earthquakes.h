// SPDX-License-Identifier: GPL-2.0-or-later
/// \file earthquakes.h
/// Earthquake catalogues in the formats that agencies publish: columns with names,
/// QuakeML, GeoJSON, ZMAP, SCEDC.
#ifndef LSM_POSTPROC_EARTHQUAKES_H
#define LSM_POSTPROC_EARTHQUAKES_H

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_bytes.h"

namespace LSM::postproc {

/// One earthquake.
struct Earthquake {
  double time = 0.0;                       ///< days since 1970-01-01T00:00 UTC
  double latitude = 0.0, longitude = 0.0;  ///< degrees; NaN if the file has none
  double magnitude = 0.0;                  ///< as in the file, of any type
};

/// Content of a file of earthquakes.
struct EarthquakeList {
  std::vector<Earthquake> events;               ///< in order of time
  std::map<std::string, std::int64_t> others;   ///< left out, by type: blasts, sonic booms, ...
  std::int64_t without_magnitude = 0;           ///< earthquakes left out
  std::map<std::string, std::int64_t> fillers;  ///< left out, by a magnitude that stands for none
  std::int64_t without_origin = 0;              ///< left out
  std::int64_t not_preferred = 0;  ///< without the preferred origin or magnitude; the first is used
  std::int64_t bad_lines = 0;      ///< skipped (lenient)
  std::string first_problem;       ///< message for the first of them
};

/// Western, eastern, southern and northern border in degrees. A region with west > east extends
/// across the date line.
struct Region {
  double west, east, south, north;
  bool contains(const Earthquake &event) const;
};

/// Parses "W/E/S/N" in degrees.
/// \throws std::invalid_argument if it is not a possible region
Region parse_region(std::string_view text);

/// What read_earthquakes() reads, for messages.
constexpr std::string_view earthquake_formats =
    "columns separated by , ; | tabs or blanks, with names such as time (or date, or year to second), "
    "latitude, longitude and mag (ComCat, NEIC, NCEDC, GeoNet, FDSN, ISC, pyCSEP); QuakeML; "
    "GeoJSON of ComCat; SCEDC; ZMAP";

/// A text without its byte order mark.
std::string_view without_mark(std::string_view content);

constexpr std::size_t head_size = 1 << 16;  ///< bytes that are enough to detect a format

/// Detects the format of a file by its first bytes, after a byte order mark: '# lsm-catalogue'
/// models, a line of column names (at most one of those needed may be missing) csv, '<' quakeml,
/// '{' geojson, a first line of data with YYYY/MM/DD, a time and a type scedc, and nine or more
/// numbers zmap. Everything else is taken for models, whose reader reports what is missing.
std::string detect_format(std::string_view content);

/// Reads the earthquakes in a file: all events but those whose type says that they are something
/// else (blasts, explosions, collapses, ...). QuakeML is read as a stream; other files may have up
/// to 1 GiB, because a small compressed file may unpack to anything.
/// \param format csv, quakeml, geojson, zmap or scedc
/// \param lenient skip and count lines (QuakeML, GeoJSON: events) that cannot be read, and go on if
/// most events are no earthquakes
/// \throws FileError
EarthquakeList read_earthquakes(files::Bytes &bytes, const std::string &format, bool lenient);

}  // namespace LSM::postproc

#endif
