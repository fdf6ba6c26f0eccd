// SPDX-License-Identifier: GPL-2.0-or-later
/// \file earthquakes.h
/// Catalogues of earthquakes as agencies give them away: ComCat's CSV, QuakeML, ZMAP, SCEDC.
#ifndef LSM_POSTPROC_EARTHQUAKES_H
#define LSM_POSTPROC_EARTHQUAKES_H

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace LSM::postproc {

/// Value of CatalogueInfo::model for earthquakes.
constexpr std::string_view seismicity = "seismicity";

struct Earthquake {
  double time = 0.0;                       ///< days since 1970-01-01T00:00 UTC
  double latitude = 0.0, longitude = 0.0;  ///< degrees
  double magnitude = 0.0;                  ///< as the file has it, whatever its type
};

/// Content of a file of earthquakes.
struct EarthquakeList {
  std::vector<Earthquake> events;              ///< in order of time
  std::map<std::string, std::int64_t> others;  ///< by type: blasts, sonic booms, ..., left out
  std::int64_t without_magnitude = 0;          ///< earthquakes left out
  std::int64_t bad_lines = 0;                  ///< passed over (lenient)
  std::string first_problem;
};

/// West, east, south and north border in degrees; west > east runs across the date line.
struct Region {
  double west, east, south, north;
  bool contains(const Earthquake &event) const;
};

/// Size of an earthquake, so that M = (2/3) log10(size) as for magnitudes of the models: an energy
/// in units of that of M = 0 (Gutenberg & Richter 1956).
double size_of_magnitude(double magnitude);

/// Days since 1970-01-01T00:00 UTC of a date and time by ISO 8601 (also with '/' and a blank for
/// '-' and 'T'): 1994-01-17, 1994-01-17T12:30:55.39Z, 1994-01-17 04:30:55-08:00. Without a zone it
/// is UTC.
std::optional<double> parse_date(std::string_view text);

/// ISO 8601 of days since 1970 to the minute: 1994-01-17T12:30Z
std::string date_text(double days);

/// "W/E/S/N" in degrees. \throws std::invalid_argument
Region parse_region(std::string_view text);

/// Format of a file by its first bytes, a byte order mark aside: '<' is quakeml, '# lsm-catalogue'
/// a catalogue of the models, a line of column names with time and mag (or magnitude) csv, a first
/// line of data that begins with YYYY/MM/DD scedc, at least nine numbers zmap; else models, whose
/// reader says what it misses.
std::string detect_format(std::string_view content);

/// Earthquakes in the text of a file. An event is one if its type is missing, 'earthquake',
/// 'induced or triggered event', or SCEDC's eq, le, re, ts.
/// \param path for messages, "path:line: what, expected ..."
/// \param lenient pass over lines (QuakeML: events) that cannot be read, and count them
/// \throws FileError
EarthquakeList read_earthquakes(std::string_view content, const std::string &format,
                                const std::string &path, bool lenient);

}  // namespace LSM::postproc

#endif
