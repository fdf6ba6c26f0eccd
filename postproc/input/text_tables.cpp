// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
      const auto ends = [](char c) { return c == '\r' || c == '\n'; };
      const auto end =
          static_cast<std::size_t>(std::find_if(rest.begin(), rest.end(), ends) - rest.begin());
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

/// Splits a line at a separator, except within double quotes (RFC 4180); a blank stands for any
/// number of blanks and tabs.
/// \param open set to whether a field that begins with a quote does not end
/// \param odd set to whether there is more in a field after its quotes
Fields split(std::string_view line, char separator, bool *open = nullptr, bool *odd = nullptr) {
  if (open) *open = false;
  if (odd) *odd = false;
  if (separator == ' ') {  // after the sign of a comment
    const std::size_t begin = line.find_first_not_of(" \t#%");
    return split_blanks(line.substr(std::min(begin, line.size())));
  }
  if (line.find('"') == line.npos) {  // most lines
    std::vector<std::string_view> parts;
    text::split(line, parts, separator);
    return Fields(parts.begin(), parts.end());
  }
  Fields fields(1);
  bool quoted = false, begins = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (!quoted) begins = text::trim(fields.back()).empty();
      if (doubled) fields.back() += line[i++];
      if (!doubled) quoted = !quoted;
      if (odd && !quoted && i + 1 < line.size() && line[i + 1] != separator) *odd = true;
    } else if (line[i] == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (open) *open = quoted && begins;
  return fields;
}

/// A line of column names.
struct Header {
  std::string_view line;
  char separator = ',';
  Fields names;
  Columns columns;
  Fields missing;  ///< names of what an event needs and the line lacks, out of 4

  Header(std::string_view line_in, char separator_in)
      : line(text::trim(line_in)), separator(separator_in), names(split(line, separator)) {
    while (names.size() > 1 && text::trim(names.back()).empty()) names.pop_back();
    columns = Columns(names);
    missing = columns.missing();
  }
  /// Whether the line is one of column names, though one of them may be missing.
  bool likely() const { return missing.size() <= 1; }
};

/// The column names in a line, which may begin as a comment (FDSN), by the separator that finds
/// most of what an event needs.
Header header_in(std::string_view line, std::string_view separators = ",;|\t ") {
  Header best(line, separators.front());
  for (const char separator : separators.substr(1)) {
    if (separator == ' ' && line.find_first_of(",;|\t") != line.npos) continue;
    Header other(line, separator);
    if (other.missing.size() < best.missing.size()) best = std::move(other);
  }
  return best;
}

/// Goes on to the line of column names, or returns the first line that is no comment. Before the
/// names may be a few lines with fewer fields, such as a title, or sep=; for spreadsheets.
Header take_header(Lines &lines, std::string_view separators = ",;|\t ") {
  constexpr std::size_t most_lines = 50;
  std::vector<std::string_view> before;
  const Lines begin = lines;
  while (before.size() < most_lines && lines.next(true)) {
    Header header = header_in(lines.line, separators);
    const bool after_title = std::all_of(before.begin(), before.end(), [&](std::string_view line) {
      return split(line, header.separator).size() < header.names.size();
    });
    if ((before.empty() ? header.likely() : header.missing.empty()) && after_title) return header;
    if (!lines.is_comment()) before.push_back(lines.line);
  }
  lines = begin;
  while (lines.next(true) && lines.is_comment()) continue;
  return header_in(lines.line, separators);
}

/// The lines of a table with names of columns. Names that are repeated, as in joined files, are no
/// line; other names count from there on.
class Table {
 public:
  explicit Table(std::string_view content) : lines_{content}, header(take_header(lines_)) {
    number = lines_.number;
  }

 private:
  Lines lines_;

 public:
  Header header;
  Fields fields;             ///< of the line
  std::int64_t number = 0;   ///< of the line, or the first of its lines
  std::string problem;       ///< why the line has no fields
  bool other_names = false;  ///< whether the line is one of other names of columns

  /// Goes on to the next line.
  bool next() {
    other_names = false;
    while (lines_.next(true)) {
      number = lines_.number;
      problem.clear();
      if (text::trim(lines_.line) == header.line ||
          lines_.line.find_first_not_of("-=+| \t") == std::string_view::npos)  // a rule
        continue;
      if (lines_.is_comment() ? take_names() : (take_fields(), !is_data() && take_names())) {
        other_names = true;
        return true;
      }
      if (!lines_.is_comment()) return true;
    }
    return false;
  }

 private:
  bool is_data() const { return problem.empty() && header.columns.has_time(fields); }

  bool take_names() {
    Header other = header_in(lines_.line);
    if (!other.missing.empty()) return false;
    header = std::move(other);
    return true;
  }

  void take_fields() {
    bool open = false, odd = false;
    fields = split(lines_.line, header.separator, &open);
    // A quoted field may have several lines.
    constexpr int most_lines = 100;
    Lines ahead = lines_;
    const char *const begin = lines_.line.data();
    for (int i = 0; open && i < most_lines && ahead.next(true); ++i) {
      const auto size = static_cast<std::size_t>(ahead.line.data() + ahead.line.size() - begin);
      // Unless a quote is missing, and this is the next line of data.
      if (split(ahead.line, header.separator).size() == header.names.size()) break;
      Fields longer = split({begin, size}, header.separator, &open, &odd);
      if (odd) break;
      if (open || longer.size() != header.names.size()) continue;
      fields = std::move(longer);
      lines_ = ahead;
      return;
    }
    const std::size_t expected = header.names.size();
    while (fields.size() > expected && text::trim(fields.back()).empty()) fields.pop_back();
    if (fields.size() > expected && is_text_last()) {
      for (std::size_t i = expected; i < fields.size(); ++i)
        fields[expected - 1] += header.separator + fields[i];
      fields.resize(expected);
    }
    if (fields.size() == expected) return;
    problem = fmt::format("{} fields, expected {}", fields.size(), expected);
    if (open || odd)
      problem += " (a quote is not closed)";
    else if (fields.size() > expected)
      problem += fmt::format(" (a field with a '{}' needs quotes)", header.separator);
  }

  /// Whether separators in excess can only be in the last column: it is not used, and those before
  /// it that are not used hold no text.
  bool is_text_last() const {
    const std::size_t last = header.names.size() - 1;
    double value = 0.0;
    for (std::size_t i = 0; i < last; ++i)
      if (!header.columns.uses(i) && !is_missing(text::trim(fields[i])) &&
          !text::parse(text::trim(fields[i]), value))
        return false;
    return !header.columns.uses(last);
  }
};

bool is_small_letters(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Whether a line begins with a date, a time of day and a type of event as in SCEDC's files.
bool begins_as_scedc(const Fields &f) {
  return f.size() > 2 && f[0].size() == 10 && f[0][4] == '/' && parse_date(f[0] + ' ' + f[1]) &&
         f[2].size() == 2 && is_small_letters(f[2]) && f[2][0] != 'm' /* ml, a magnitude */;
}

}  // namespace

void read_columns(std::string_view content, Collector &out) {
  Table table(content);
  if (!table.header.missing.empty())
    out.fail(table.number, "column names without " + either(table.header.missing, " and ") +
                               ", expected such as those of ComCat, NEIC, NCEDC, GeoNet or FDSN");
  const auto learn = [](Table &from) {
    for (Table other = from; other.next() && !other.other_names;)
      if (other.problem.empty()) from.header.columns.learn(other.fields);
  };
  learn(table);
  while (table.next()) {
    if (table.other_names) {
      learn(table);
    } else if (!table.problem.empty()) {
      out.bad(table.number, table.problem);
    } else {
      const Record record = table.header.columns.record_of(table.fields);
      const bool empty =
          record.time.empty() && std::all_of(record.texts.begin(), record.texts.end(), is_missing);
      if (!empty) out.add(record, table.number);  // empty: as after an export of a spreadsheet
    }
  }
}

void read_scedc(std::string_view content, Collector &out) {
  for (Lines lines{content}; lines.next();) {
    Fields f = split_blanks(lines.line);
    const std::size_t fields = f.size();
    double number = 0.0;
    for (const std::size_t text : {3u, 5u})  // a number instead: the text is missing
      if (f.size() > text && text::parse(f[text], number))
        f.insert(f.begin() + static_cast<std::ptrdiff_t>(text), std::string());
    const bool good = f.size() >= 9 && begins_as_scedc(f) && f[3].size() <= 1 &&
                      is_small_letters(f[3]) && f[5].size() <= 2 && is_small_letters(f[5]);
    if (!good) {
      out.bad(lines.number, fmt::format("{} fields, expected date, time, event type, place type, "
                                        "magnitude, its type, latitude, longitude, depth, ...",
                                        fields));
      continue;
    }
    Record record;
    record.time = f[0] + ' ' + f[1];
    record.at = parse_date(record.time);
    record[Field::type] = f[2];
    record[Field::magnitude] = f[5] == "n" ? std::string() : f[4];
    record[Field::latitude] = f[6];
    record[Field::longitude] = f[7];
    out.add(record, lines.number);
  }
}

void read_zmap(std::string_view content, Collector &out) {
  const Fields names =
      split_blanks("longitude latitude year month day mag depth hour minute second");
  const Columns columns(names);
  for (Lines lines{content}; lines.next();) {
    Fields f = split_blanks(lines.line);
    double number = 0.0;
    const bool good = f.size() >= 9;
    f.resize(names.size());
    const Record record = columns.record_of(f);
    if (good && record.at && std::all_of(f.begin(), f.end(), [&](const std::string &text) {
          return text::parse(text, number) || is_missing(text);
        }))
      out.add(record, lines.number);
    else
      out.bad(lines.number,
              "no event of ZMAP, expected longitude, latitude, year (of four digits), month, day, "
              "magnitude, depth, hour, minute and, if known, second");
  }
}

std::string detect_format(std::string_view content) {
  content = without_mark(content);
  Lines lines{content};
  if (content.substr(0, catalogue_magic.size()) == catalogue_magic) return "models";
  const std::string_view first = lines.next() ? text::trim(lines.line) : std::string_view();
  if (first.substr(0, 1) == "<") return "quakeml";
  if (first.substr(0, 1) == "{") return "geojson";
  const Fields fields = split_blanks(first);
  Lines again{content}, blanks{content};
  if (take_header(again, ",;|\t").likely()) return "csv";
  if (begins_as_scedc(fields)) return "scedc";
  if (take_header(blanks, " ").likely()) return "csv";
  double number = 0.0;
  const bool numbers =
      fields.size() >= 9 && std::all_of(fields.begin(), fields.begin() + 9, [&](auto &field) {
        return text::parse(field, number) || is_missing(field);
      });
  return numbers ? "zmap" : "models";
}

}  // namespace LSM::postproc
