// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"

#include <date/date.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>

#include "files/catalogue.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

using Fields = std::vector<std::string>;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a number of `digits` digits from the front of the text.
bool take(std::string_view &text, std::size_t digits, int &value) {
  if (text.size() < digits) return false;
  value = 0;
  for (const char c : text.substr(0, digits)) {
    if (!is_digit(c)) return false;
    value = 10 * value + (c - '0');
  }
  text.remove_prefix(digits);
  return true;
}

bool take(std::string_view &text, std::string_view one_of) {
  if (text.empty() || one_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Days since 1970, or nothing for an impossible date. Seconds may be 60 or more, as in leap
/// seconds and in the rounded times of SCEDC.
std::optional<double> days(int year, int month, int day, int hour, int minute, double second) {
  const date::year_month_day when{date::year(year), date::month(static_cast<unsigned>(month)),
                                  date::day(static_cast<unsigned>(day))};
  if (!when.ok() || hour > 24 || minute > 59 || !(second >= 0.0 && second < 61.0)) return {};
  const auto whole = static_cast<double>(date::sys_days(when).time_since_epoch().count());
  return whole + (hour * 3600.0 + minute * 60.0 + second) / 86400.0;
}

/// Takes "hh:mm[:ss[.fff]]" from the front of the text.
bool take_clock(std::string_view &text, int &hour, int &minute, double &second) {
  if (!take(text, 2, hour) || !take(text, ":") || !take(text, 2, minute)) return false;
  if (!take(text, ":")) return true;
  const std::size_t end = text.find_first_not_of("0123456789.");
  const bool good = text_io::parse(text.substr(0, end), second);
  text.remove_prefix(std::min(end, text.size()));
  return good;
}

/// Takes a time zone from the front of the text, in minutes ahead of UTC.
bool take_zone(std::string_view &text, int &ahead) {
  if (text.empty() || take(text, "Zz")) return true;
  const bool behind = text.front() == '-';
  int hours = 0, minutes = 0;
  if (!take(text, "+-") || !take(text, 2, hours)) return false;
  take(text, ":");
  if (!text.empty() && !take(text, 2, minutes)) return false;
  ahead = (behind ? -1 : 1) * (60 * hours + minutes);
  return true;
}

std::string in_small_letters(std::string_view text) {
  std::string out(text);
  for (char &c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool is_earthquake(const std::string &type) {
  static const std::set<std::string> names = {
      "", "earthquake", "induced or triggered event", "eq", "eql", "eqr", "le", "re", "ts"};
  return names.count(in_small_letters(type)) > 0;
}

/// The fields of one event as in the file; those that the file does not have are empty.
struct Row {
  std::string_view time, latitude, longitude, magnitude, type;
  std::optional<double> at;  ///< the time, in formats that have it as several numbers
};

/// Collects the earthquakes from the lines or elements of a file.
class Collector {
 public:
  Collector(std::string path, bool lenient) : path_(std::move(path)), lenient_(lenient) {}

  void add(const Row &row, std::int64_t line) {
    Earthquake event;
    const auto number = [&](std::string_view text, const char *name, double most, double &value) {
      if (text_io::parse(text, value) && std::fabs(value) <= most) return true;
      bad(line, std::string(name) + " is " + text_io::in_quotes(text) + ", expected a number");
      return false;
    };
    const std::optional<double> at = row.at ? row.at : parse_date(row.time);
    if (!at)
      return bad(line, "time is " + text_io::in_quotes(row.time) +
                           ", expected a date and time such as 1994-01-17T12:30:55.39Z");
    event.time = *at;
    if (!number(row.latitude, "latitude", 90.0, event.latitude) ||
        !number(row.longitude, "longitude", 360.0, event.longitude))
      return;
    if (!is_earthquake(std::string(row.type))) {
      ++list_.others[std::string(row.type)];
      return;
    }
    if (row.magnitude.empty()) {
      ++list_.without_magnitude;
      return;
    }
    if (number(row.magnitude, "magnitude", 12.0, event.magnitude)) list_.events.push_back(event);
  }

  [[noreturn]] void fail(std::int64_t line, const std::string &what) const {
    throw FileError(text_io::where(path_, line) + what);
  }
  /// Handles a line that cannot be read: counts it if lenient.
  /// \throws FileError otherwise
  void bad(std::int64_t line, const std::string &what) {
    if (!lenient_) fail(line, what);
    if (list_.bad_lines++ == 0) list_.first_problem = text_io::where(path_, line) + what;
  }

  EarthquakeList finish() {
    std::stable_sort(list_.events.begin(), list_.events.end(),
                     [](const Earthquake &a, const Earthquake &b) { return a.time < b.time; });
    return std::move(list_);
  }

 private:
  std::string path_;
  bool lenient_;
  EarthquakeList list_;
};

/// The lines of a file without their ends ('\n', '\r\n' or '\r'). Comments and empty lines are
/// skipped.
struct Lines {
  std::string_view rest, line = {};
  std::int64_t number = 0;

  bool next() {
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      line = text_io::trim(rest.substr(0, end));
      rest.remove_prefix(end);
      rest.remove_prefix(rest.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(1, rest.size()));
      ++number;
      if (!line.empty() && line.front() != '#' && line.front() != '%') return true;
    }
    return false;
  }
};

/// Splits a line at commas, except those in double quotes (RFC 4180).
Fields split_csv(std::string_view line) {
  Fields fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) fields.back() += line[i++];
      if (!doubled) quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

Fields split_blanks(std::string_view line) {
  Fields fields;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(" \t,");
    if (begin == std::string_view::npos) return fields;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
    fields.emplace_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

/// Index of a column, or -1. `wanted` are its possible names in lower case; the first one that is
/// there counts.
int column(const Fields &names, std::initializer_list<std::string_view> wanted) {
  for (const std::string_view one : wanted)
    for (std::size_t i = 0; i < names.size(); ++i)
      if (in_small_letters(text_io::trim(names[i])) == one) return static_cast<int>(i);
  return -1;
}

/// Indices of the columns, -1 for missing ones. The time is one column (ComCat, NCEDC); a date and
/// the time of day; or year, month, day and hhmmss.ss (both NEIC).
struct CsvColumns {
  int latitude, longitude, magnitude, type, time, date, year, month, day, clock;

  bool complete() const {
    return latitude >= 0 && longitude >= 0 && magnitude >= 0 &&
           (time >= 0 || (year >= 0 && month >= 0 && day >= 0 && clock >= 0));
  }
};
CsvColumns csv_columns(const Fields &names) {
  const auto place = [&names](std::initializer_list<std::string_view> wanted) {
    return column(names, wanted);
  };
  return {place({"latitude", "lat"}),
          place({"longitude", "lon"}),
          place({"mag", "magnitude"}),
          place({"type", "event_type", "eventtype"}),
          place({"time", "datetime", "timeutc", "origin_time"}),
          place({"date"}),
          place({"year"}),
          place({"month"}),
          place({"day"}),
          place({"time(hhmmss.mm)utc", "time(hhmmss.ss)utc"})};
}

/// Converts "MM/DD/YYYY" to YYYY-MM-DD, and returns other texts unchanged.
std::string iso_date(std::string_view text) {
  if (text.size() != 10 || text[2] != '/' || text[5] != '/') return std::string(text);
  return std::string(text.substr(6)) + '-' + std::string(text.substr(0, 2)) + '-' +
         std::string(text.substr(3, 2));
}
/// Converts hhmmss.ss, in which leading zeros may be missing, to hh:mm:ss.ss, and returns other
/// texts unchanged.
std::string iso_clock(std::string_view text) {
  const std::size_t whole = std::min(text.find('.'), text.size());
  if (whole > 6 ||
      !std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(whole), is_digit))
    return std::string(text);
  const std::string digits = std::string(6 - whole, '0') + std::string(text);
  return digits.substr(0, 2) + ':' + digits.substr(2, 2) + ':' + digits.substr(4);
}

void read_csv(std::string_view content, Collector &out) {
  Lines lines{content};
  const Fields names = lines.next() ? split_csv(lines.line) : Fields();
  const CsvColumns columns = csv_columns(names);
  if (!columns.complete())
    out.fail(lines.number,
             "column names without time, latitude, longitude and mag, expected those of ComCat, "
             "NEIC or NCEDC");
  while (lines.next()) {
    const Fields fields = split_csv(lines.line);
    if (fields.size() != names.size()) {
      out.bad(lines.number,
              std::to_string(fields.size()) + " fields, expected " + std::to_string(names.size()));
      continue;
    }
    const auto field = [&](int place) {
      return place < 0 ? std::string_view()
                       : text_io::trim(fields[static_cast<std::size_t>(place)]);
    };
    std::string time(field(columns.time));
    if (columns.time >= 0 && columns.date >= 0) {
      time = iso_date(field(columns.date)) + ' ' + time;
    } else if (columns.time < 0) {
      const auto two = [](std::string_view number) {
        return (number.size() == 1 ? "-0" : "-") + std::string(number);
      };
      time = std::string(field(columns.year)) + two(field(columns.month)) +
             two(field(columns.day)) + ' ' + iso_clock(field(columns.clock));
    }
    out.add({time,
             field(columns.latitude),
             field(columns.longitude),
             field(columns.magnitude),
             field(columns.type),
             {}},
            lines.number);
  }
}

/// Columns: date, time of day, type of event, geographic type, magnitude, its type, latitude,
/// longitude, ...
void read_scedc(std::string_view content, Collector &out) {
  for (Lines lines{content}; lines.next();) {
    const Fields f = split_blanks(lines.line);
    if (f.size() < 9)
      out.bad(lines.number, std::to_string(f.size()) +
                                " fields, expected date, time, event type, place type, magnitude, "
                                "its type, latitude, longitude, depth, ...");
    else
      out.add({f[0] + ' ' + f[1], f[6], f[7], f[4], f[2], {}}, lines.number);
  }
}

/// Columns: longitude, latitude, year, month, day, magnitude, depth, hour, minute[, second]. The
/// year may have a fraction, which only repeats month and day.
void read_zmap(std::string_view content, Collector &out) {
  for (Lines lines{content}; lines.next();) {
    const Fields f = split_blanks(lines.line);
    std::array<double, 10> v{};
    bool good = f.size() >= 9;
    for (std::size_t i = 0; good && i < std::min(f.size(), v.size()); ++i)
      good = text_io::parse(f[i], v[i]) || (i == 5 && f[i] == "NaN");
    for (const std::size_t whole : {3u, 4u, 7u, 8u})
      good = good && v[whole] >= 0.0 && v[whole] <= 60.0 && v[whole] == std::floor(v[whole]);
    std::optional<double> at;
    if (good && std::fabs(v[2]) <= 1e4)
      at = days(static_cast<int>(v[2]), static_cast<int>(v[3]), static_cast<int>(v[4]),
                static_cast<int>(v[7]), static_cast<int>(v[8]), v[9]);
    if (at)
      out.add({{}, f[1], f[0], f[5] == "NaN" ? std::string_view() : std::string_view(f[5]), {}, at},
              lines.number);
    else
      out.bad(lines.number,
              "no event of ZMAP, expected longitude, latitude, year, month, day, magnitude, "
              "depth, hour, minute and, if known, second");
  }
}

/// The child `name` of an event whose publicID is given in the element `by`, or the first one.
pugi::xml_node preferred(const pugi::xml_node &event, const char *name, const char *by) {
  const std::string_view id = text_io::trim(event.child_value(by));
  for (const pugi::xml_node &one : event.children(name))
    if (!id.empty() && one.attribute("publicID").value() == id) return one;
  return event.child(name);
}

/// Removes namespace prefixes from the names of elements. A file may use any prefix for the
/// namespace of QuakeML, and elements of other namespaces do not have its names.
struct Unprefixed : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node &node) override {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    if (colon != std::string_view::npos) node.set_name(std::string(name.substr(colon + 1)).c_str());
    return true;
  }
};

void read_quakeml(std::string_view content, Collector &out, const std::string &path) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(content.data(), content.size());
  const auto line_of = [content](std::ptrdiff_t offset) {
    return 1 + std::count(content.begin(), content.begin() + offset, '\n');
  };
  if (!parsed)
    throw FileError(text_io::where(path, line_of(parsed.offset)) + parsed.description() +
                    ", expected QuakeML");
  Unprefixed walker;
  document.traverse(walker);
  const pugi::xml_node events = document.document_element().child("eventParameters");
  if (!events) throw FileError(path + ": no element eventParameters, expected QuakeML");
  for (const pugi::xml_node &event : events.children("event")) {
    const pugi::xml_node origin = preferred(event, "origin", "preferredOriginID");
    const pugi::xml_node magnitude = preferred(event, "magnitude", "preferredMagnitudeID");
    const auto value = [](const pugi::xml_node &of, const char *name) {
      return text_io::trim(of.child(name).child_value("value"));
    };
    out.add({value(origin, "time"),
             value(origin, "latitude"),
             value(origin, "longitude"),
             value(magnitude, "mag"),
             text_io::trim(event.child_value("type")),
             {}},
            line_of(event.offset_debug()));
  }
}

std::string_view without_mark(std::string_view content) {
  return content.substr(content.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0);
}

}  // namespace

bool Region::contains(const Earthquake &event) const {
  if (event.latitude < south || event.latitude > north) return false;
  if (east - west >= 360.0) return true;
  const auto eastwards = [this](double longitude) {
    const double turn = std::fmod(longitude - west, 360.0);
    return turn < 0.0 ? turn + 360.0 : turn;
  };
  return eastwards(event.longitude) <= eastwards(east);
}

double size_of_magnitude(double magnitude) { return std::pow(10.0, 1.5 * magnitude); }

std::optional<double> parse_date(std::string_view text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, ahead = 0;
  double second = 0.0;
  if (!take(text, 4, year) || !take(text, "-/") || !take(text, 2, month) || !take(text, "-/") ||
      !take(text, 2, day))
    return {};
  if (!text.empty() && (!take(text, "Tt ") || !take_clock(text, hour, minute, second) ||
                        !take_zone(text, ahead) || !text.empty()))
    return {};
  const auto local = days(year, month, day, hour, minute, second);
  if (!local) return {};
  return *local - ahead / 1440.0;
}

std::string date_text(double days) {
  return date::format("%FT%RZ", date::sys_time<std::chrono::minutes>(
                                    std::chrono::minutes(std::llround(days * 1440.0))));
}

Region parse_region(std::string_view text) {
  std::array<double, 4> v{};
  std::string_view rest = text;
  bool good = true;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t slash = rest.find('/');
    good = good && (slash == std::string_view::npos) == (i == 3) &&
           text_io::parse(rest.substr(0, slash), v[i]);
    rest.remove_prefix(slash == std::string_view::npos ? rest.size() : slash + 1);
  }
  if (!good || !(v[2] < v[3]) || std::fabs(v[2]) > 90.0 || std::fabs(v[3]) > 90.0 ||
      std::fabs(v[0]) > 360.0 || std::fabs(v[1]) > 360.0 || v[0] == v[1] || v[0] - v[1] >= 360.0)
    throw std::invalid_argument("--region " + text_io::in_quotes(text) +
                                ", expected W/E/S/N in degrees, such as -122/-114/32/37");
  return {v[0], v[1], v[2], v[3]};
}

std::string detect_format(std::string_view content) {
  content = without_mark(content);
  Lines lines{content};
  if (content.substr(0, catalogue_magic.size()) == catalogue_magic || !lines.next())
    return "models";
  if (lines.line.front() == '<') return "quakeml";
  if (csv_columns(split_csv(lines.line)).complete()) return "csv";
  if (lines.line.size() > 10 && lines.line[4] == '/' && parse_date(lines.line.substr(0, 10)))
    return "scedc";
  const Fields fields = split_blanks(lines.line);
  double number = 0.0;
  const bool numbers =
      fields.size() >= 9 && std::all_of(fields.begin(), fields.begin() + 5,
                                        [&](auto &field) { return text_io::parse(field, number); });
  return numbers ? "zmap" : "models";
}

EarthquakeList read_earthquakes(std::string_view content, const std::string &format,
                                const std::string &path, bool lenient) {
  Collector out(path, lenient);
  content = without_mark(content);
  if (text_io::is_utf16(content)) throw FileError(path + text_io::utf16_text);
  if (content.substr(0, (1 << 16)).find('\0') != std::string_view::npos)
    throw FileError(path + ": has bytes of 0, expected text");
  if (format == "csv") read_csv(content, out);
  if (format == "quakeml") read_quakeml(content, out, path);
  if (format == "zmap") read_zmap(content, out);
  if (format == "scedc") read_scedc(content, out);
  return out.finish();
}

}  // namespace LSM::postproc
