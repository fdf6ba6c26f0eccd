// SPDX-License-Identifier: GPL-2.0-or-later
#include "text_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>

#include "event_time.h"
#include "files/catalogue.h"
#include "files/names.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

/// The lines of a file without their ends ('\n', '\r\n' or '\r'). Empty lines are skipped.
struct Lines {
  std::string_view rest, line = {};
  std::int64_t number = 0;

  /// Goes on to the next line, by default to one that is no comment.
  bool next(bool comments = false) {
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      line = rest.substr(0, end);
      rest.remove_prefix(end);
      rest.remove_prefix(rest.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(1, rest.size()));
      ++number;
      if (!text::trim(line).empty() && (comments || !is_comment())) return true;
    }
    return false;
  }
  bool is_comment() const {
    const char first = text::trim(line).front();
    return first == '#' || first == '%';
  }
};

/// Splits a line at a separator, except within double quotes (RFC 4180).
Fields split_quoted(std::string_view line, char separator) {
  Fields fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) fields.back() += line[i++];
      if (!doubled) quoted = !quoted;
    } else if (line[i] == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

/// A line of column names.
struct Header {
  char separator = ',';
  std::size_t columns = 0;
  Places places{};
  Fields missing;  ///< names of what an event needs and the line lacks, out of 4

  Header(std::string_view line, char separator_in) : separator(separator_in) {
    const Fields names = split_quoted(line, separator);
    columns = names.size();
    places = places_in(names);
    const auto has = [this](Field field) { return places[static_cast<std::size_t>(field)] >= 0; };
    if (!has(Field::time) && !has(Field::date) &&
        !(has(Field::year) && has(Field::month) && has(Field::day)))
      missing.push_back("time");
    if (!has(Field::latitude)) missing.push_back("latitude");
    if (!has(Field::longitude)) missing.push_back("longitude");
    if (!has(Field::magnitude)) missing.push_back("mag");
  }
  /// Whether the line is one of column names, though one of them may be missing.
  bool likely() const { return missing.size() <= 1; }
};

/// The column names in a line, which may begin as a comment (FDSN), by the separator that finds
/// most of what an event needs.
Header header_in(std::string_view line) {
  Header best(line, ',');
  for (const char separator : {';', '|', '\t'}) {
    Header other(line, separator);
    if (other.missing.size() < best.missing.size()) best = other;
  }
  return best;
}

/// Goes on to the line of column names or, if there is none, to the first that is no comment.
Header take_header(Lines &lines) {
  while (lines.next(true)) {
    const Header header = header_in(lines.line);
    if (header.likely() || !lines.is_comment()) return header;
  }
  return Header({}, ',');
}

}  // namespace

void read_columns(std::string_view content, Collector &out) {
  Lines lines{content};
  const Header header = take_header(lines);
  if (!header.missing.empty())
    out.fail(lines.number, "column names without " + either(header.missing, " and ") +
                               ", expected such as those of ComCat, NEIC, NCEDC, GeoNet or FDSN");
  while (lines.next()) {
    const Fields fields = split_quoted(lines.line, header.separator);
    if (fields.size() == header.columns)
      out.add(record_of(fields, header.places), lines.number);
    else
      out.bad(lines.number, fmt::format("{} fields, expected {}", fields.size(), header.columns));
  }
}

void read_scedc(std::string_view content, Collector &out) {
  for (Lines lines{content}; lines.next();) {
    Fields f = split_blanks(lines.line);
    double number = 0.0;
    for (const std::size_t text : {3u, 5u})  // a number instead: the text is missing
      if (f.size() > text && text::parse(f[text], number))
        f.insert(f.begin() + static_cast<std::ptrdiff_t>(text), std::string());
    if (f.size() < 9) {
      out.bad(lines.number, fmt::format("{} fields, expected date, time, event type, place type, "
                                        "magnitude, its type, latitude, longitude, depth, ...",
                                        split_blanks(lines.line).size()));
      continue;
    }
    Record record;
    record[Field::time] = f[0] + ' ' + f[1];
    record[Field::type] = f[2];
    record[Field::magnitude] = f[5] == "n" ? std::string() : f[4];
    record[Field::latitude] = f[6];
    record[Field::longitude] = f[7];
    record[Field::depth] = f[8];
    out.add(record, lines.number);
  }
}

void read_zmap(std::string_view content, Collector &out) {
  constexpr Field columns[] = {Field::longitude, Field::latitude,  Field::year,  Field::month,
                               Field::day,       Field::magnitude, Field::depth, Field::hour,
                               Field::minute,    Field::second};
  for (Lines lines{content}; lines.next();) {
    const Fields f = split_blanks(lines.line);
    Record record;
    double number = 0.0;
    bool good = f.size() >= 9;
    for (std::size_t i = 0; good && i < std::min(f.size(), std::size(columns)); ++i) {
      good = text::parse(f[i], number) || is_missing(f[i]);
      record[columns[i]] = f[i];
    }
    record.at = good ? time_in_parts(record) : std::nullopt;
    if (record.at)
      out.add(record, lines.number);
    else
      out.bad(
          lines.number,
          "no event of ZMAP, expected longitude, latitude, year (of four digits), month, day, magnitude, "
          "depth, hour, minute and, if known, second");
  }
}

std::string detect_format(std::string_view content) {
  content = without_mark(content);
  Lines lines{content};
  if (content.substr(0, catalogue_magic.size()) == catalogue_magic) return "models";
  const std::string_view first = lines.next() ? text::trim(lines.line) : std::string_view();
  if (first.substr(0, 1) == "<") return "quakeml";
  if (first.substr(0, 1) == "{") return "geojson";
  Lines again{content};
  if (take_header(again).likely()) return "csv";
  if (first.size() > 10 && first[4] == '/' && parse_date(first.substr(0, 10))) return "scedc";
  const Fields fields = split_blanks(first);
  double number = 0.0;
  const bool numbers =
      fields.size() >= 9 && std::all_of(fields.begin(), fields.begin() + 9, [&](auto &field) {
        return text::parse(field, number) || is_missing(field);
      });
  return numbers ? "zmap" : "models";
}

}  // namespace LSM::postproc
