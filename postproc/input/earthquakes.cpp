// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"

#include <date/date.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>

#include "files/catalogue.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/names.h"
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
  const bool good = text::parse(text.substr(0, end), second);
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

/// Whether a text stands for a value that is missing.
bool is_missing(std::string_view text) {
  static const std::set<std::string, std::less<>> words = {"",    "nan", "null", "none", "na",
                                                           "n/a", "-",   "--",   "---"};
  return words.count(in_small_letters(text)) > 0;
}

/// Whether a type says that an event is no earthquake: names of QuakeML and ComCat, the codes of
/// SCEDC and NCEDC, and those of ISC and EMSC (IMS 1.0). What only may be something else is none of
/// these: unknown, not reported, other event, induced events (rock bursts are among them), and
/// everything that is not listed, such as the types of magnitudes in a column TYPE.
bool is_no_earthquake(std::string_view type) {
  static const std::set<std::string, std::less<>> codes = {
      "qb", "sn", "nt", "th", "sh", "px", "bc", "ce", "co", "df", "ls", "rs",  // SCEDC, NCEDC
      "av", "ex", "su", "ve", "vt", "km", "sm", "kh", "kx", "sx", "kn"};
  constexpr std::string_view parts[] = {
      "blast",           "explosi",      "quarry",    "detonati", "nuclear",     "artillery",
      "rocket",          "aircraft",     "crash",     "collapse", "sonic",       "acoustic",
      "noise",           "thunder",      "meteor",    "slide",    "rockfall",    "avalanche",
      "debris",          "lahar",        "pyroclast", "erupti",   "calving",     "atmospheric",
      "volcanic tremor", "tremor pulse", "ice quake", "icequake", "frost quake", "surface event",
      "duplicate",       "not existing", "road cut"};
  std::string text = in_small_letters(type);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
  return codes.count(text) > 0 || std::any_of(std::begin(parts), std::end(parts), [&](auto part) {
           return text.find(part) != std::string::npos;
         });
}

/// What files may hold of an event.
enum Field {
  time,
  date,
  year,
  month,
  day,
  hour,
  minute,
  second,
  latitude,
  longitude,
  magnitude,
  type,
  depth,
  number_of_fields
};

/// One event as in the file, with empty texts for what the file does not have.
struct Record {
  std::array<std::string, number_of_fields> texts = {};
  std::optional<double> at = {};  ///< the time, in formats that have it as a number
  double depth_per_km = 1.0;

  std::string &operator[](Field field) { return texts[field]; }
  const std::string &operator[](Field field) const { return texts[field]; }
};

/// The names of each field, in its order, as columns and as properties in GeoJSON: in small
/// letters, without blanks, signs and units. The first one that a file has counts.
constexpr std::array<std::string_view, number_of_fields> known_names = {
    "time datetime timeutc utctime datetimeutc origintime origintimeutc timestring timestamp eventtime",
    "date origindate eventdate",
    "year yr",
    "month mon mo",
    "day dy da",
    "hour hr ho",
    "minute min mi",
    "second seconds sec se",
    "latitude lat",
    "longitude lon long lng",
    "mag magnitude mw",
    "eventtype evtype etype type",
    "depth dep depthkm"};

/// A name as in `known_names`.
std::string plain(std::string_view name) {
  std::string out;
  for (const char c : in_small_letters(name.substr(0, name.find_first_of("(/["))))
    if (is_digit(c) || (c >= 'a' && c <= 'z')) out += c;
  return out;
}

/// Converts "MM/DD/YYYY" to YYYY-MM-DD, and returns other texts unchanged.
std::string iso_date(std::string_view text) {
  if (text.size() != 10 || text[2] != '/' || text[5] != '/') return std::string(text);
  return fmt::format("{}-{}-{}", text.substr(6), text.substr(0, 2), text.substr(3, 2));
}
/// Converts hhmmss.ss, in which leading zeros may be missing, to hh:mm:ss.ss, and returns other
/// texts unchanged.
std::string iso_clock(std::string_view text) {
  const std::size_t whole = std::min(text.find('.'), text.size());
  if (text.empty() || whole > 6 || !std::all_of(text.begin(), text.begin() + whole, is_digit))
    return std::string(text);
  const std::string digits = std::string(6 - whole, '0') + std::string(text);
  return digits.substr(0, 2) + ':' + digits.substr(2, 2) + ':' + digits.substr(4);
}

/// Days since 1970 of year, month, day, and the time of day if it is known; the year may have a
/// fraction, which only repeats the others. Years of two digits are refused, as nobody knows their
/// century.
std::optional<double> time_in_parts(const Record &record) {
  std::array<double, 6> v{};  // year, month, day, hour, minute, second
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string_view text = record.texts[year + i];
    if (!text::parse(text, v[i]) && !(i >= 3 && is_missing(text))) return {};
    if (i > 0 && i < 5 && (v[i] < 0.0 || v[i] > 60.0 || v[i] != std::floor(v[i]))) return {};
  }
  if (!(v[0] >= 100.0 && v[0] < 1e4)) return {};
  const auto whole = [&v](std::size_t i) { return static_cast<int>(v[i]); };
  const std::string of_day = iso_clock(record[time]);
  if (of_day.empty()) return days(whole(0), whole(1), whole(2), whole(3), whole(4), v[5]);
  return parse_date(fmt::format("{:04}-{:02}-{:02} {}", whole(0), whole(1), whole(2), of_day));
}

/// Days since 1970, from what a record has.
std::optional<double> time_of(const Record &record) {
  if (record.at) return record.at;
  if (!record[date].empty())
    return parse_date(iso_date(record[date]) +
                      (is_missing(record[time]) ? "" : " " + record[time]));
  const std::optional<double> at = parse_date(record[time]);
  return at || record[year].empty() ? at : time_in_parts(record);
}

/// Collects the earthquakes from the lines or elements of a file.
class Collector {
 public:
  Collector(std::string path, bool lenient) : path_(std::move(path)), lenient_(lenient) {}

  void add(const Record &record, std::int64_t line) {
    Earthquake event;
    const auto number = [&](Field field, const char *name, double most, double &value) {
      const std::string &text = record[field];
      if (field != magnitude && is_missing(text)) {
        value = NAN;
        return true;
      }
      if (text::parse(text, value) && std::fabs(value) <= most) return true;
      bad(line, fmt::format("{} is {}, expected a number", name, text::in_quotes(text)));
      return false;
    };
    const std::optional<double> at = time_of(record);
    if (!at) return bad(line, bad_time(record));
    event.time = *at;
    if (!number(latitude, "latitude", 90.0, event.latitude) ||
        !number(longitude, "longitude", 360.0, event.longitude))
      return;
    // A depth only goes on to other files.
    event.depth = text::parse(record[depth], event.depth) ? event.depth / record.depth_per_km : NAN;
    if (is_no_earthquake(record[type]))
      ++list_.others[record[type]];
    else if (is_missing(record[magnitude]))
      ++list_.without_magnitude;
    else if (number(magnitude, "magnitude", 12.0, event.magnitude))
      list_.events.push_back(event);
  }
  /// Counts an event of which the file lacks the preferred origin or magnitude.
  void add_unpreferred() { ++list_.not_preferred; }

  /// What messages count, if not lines.
  void count_in(std::string_view unit) { unit_ = unit; }
  [[noreturn]] void fail(std::int64_t line, const std::string &what) const {
    throw FileError(where(line) + what);
  }
  /// Handles a line that cannot be read: counts it if lenient.
  /// \throws FileError otherwise
  void bad(std::int64_t line, const std::string &what) {
    if (!lenient_) fail(line, what);
    if (list_.bad_lines++ == 0) list_.first_problem = where(line) + what;
  }

  /// \throws FileError if most events are no earthquakes, unless lenient
  EarthquakeList finish() {
    std::int64_t others = 0;
    std::string types;
    for (const auto &[name, count] : list_.others) {
      others += count;
      types +=
          fmt::format("{}{} of type {}", types.empty() ? "" : ", ", count, text::in_quotes(name));
    }
    const auto all =
        others + list_.without_magnitude + static_cast<std::int64_t>(list_.events.size());
    if (2 * others > all && !lenient_)
      throw FileError(fmt::format(
          "{}: {} of {} events are no earthquakes ({}), expected less than half; --lenient leaves "
          "them out",
          path_, others, all, types));
    std::stable_sort(list_.events.begin(), list_.events.end(),
                     [](const Earthquake &a, const Earthquake &b) { return a.time < b.time; });
    return std::move(list_);
  }

 private:
  std::string where(std::int64_t number) const {
    return unit_.empty() ? text::where(path_, number)
                         : fmt::format("{}: {} {}: ", path_, unit_, number);
  }
  static std::string bad_time(const Record &record) {
    std::string text = record[time];
    for (const Field field : {date, year, month, day, hour, minute, second})
      if (!record[field].empty()) text += (text.empty() ? "" : " ") + record[field];
    return "time is " + text::in_quotes(text) +
           ", expected a date and time such as 1994-01-17T12:30:55.39Z";
  }

  std::string path_;
  std::string_view unit_;
  bool lenient_;
  EarthquakeList list_;
};

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

/// Position of each field among names of columns or properties; -1: missing.
using Places = std::array<std::ptrdiff_t, number_of_fields>;
Places places_in(const Fields &names) {
  Fields plain_names;
  for (const std::string &name : names) plain_names.push_back(plain(name));
  Places places;
  places.fill(-1);
  for (std::size_t field = 0; field < places.size(); ++field)
    for (const std::string &known : split_blanks(known_names[field])) {
      const auto at = std::find(plain_names.begin(), plain_names.end(), known);
      if (places[field] < 0 && at != plain_names.end()) places[field] = at - plain_names.begin();
    }
  return places;
}

/// The record whose values, in the order of the names, are these.
Record record_of(const Fields &values, const Places &places) {
  Record record;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= 0) record.texts[i] = text::trim(values[static_cast<std::size_t>(places[i])]);
  return record;
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
    const auto has = [this](Field field) { return places[field] >= 0; };
    if (!has(time) && !has(date) && !(has(year) && has(month) && has(day)))
      missing.push_back("time");
    if (!has(latitude)) missing.push_back("latitude");
    if (!has(longitude)) missing.push_back("longitude");
    if (!has(magnitude)) missing.push_back("mag");
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

/// Numbers of lines, counted once over the whole text if the offsets ascend.
struct LineCounter {
  std::string_view text;
  std::size_t counted = 0;
  std::int64_t line = 1;

  std::int64_t of(std::ptrdiff_t offset) {
    for (; static_cast<std::ptrdiff_t>(counted) < offset && counted < text.size(); ++counted)
      line += text[counted] == '\n';
    return line;
  }
};

/// A collection of GeoJSON as ComCat writes it: times in milliseconds since 1970, places as
/// coordinates. The names of properties are those of columns.
void read_geojson(std::string_view content, Collector &out) {
  using nlohmann::json;
  json document;
  try {
    document = json::parse(content);
  } catch (const json::parse_error &error) {
    out.fail(LineCounter{content}.of(static_cast<std::ptrdiff_t>(error.byte) - 1),
             "no JSON, expected GeoJSON");
  }
  const auto text_of = [](const json &value) {
    return value.is_string() ? value.get<std::string>()
           : value.is_null() ? std::string()
                             : value.dump();
  };
  const auto member = [](const json &of, const char *name) -> const json & {
    static const json none;
    return of.is_object() && of.contains(name) ? of.at(name) : none;
  };
  const json &features = member(document, "features");
  if (!features.is_array()) out.fail(1, "no array 'features', expected GeoJSON");
  out.count_in("feature");
  std::int64_t number = 0;
  for (const json &feature : features) {
    ++number;
    const json &properties = member(feature, "properties");
    const json &coordinates = member(member(feature, "geometry"), "coordinates");
    Fields names, values;
    for (const auto &[name, value] : properties.items()) {
      names.push_back(name);
      values.push_back(text_of(value));
    }
    Record record = record_of(values, places_in(names));
    if (coordinates.is_array() && coordinates.size() >= 2) {
      record[longitude] = text_of(coordinates[0]);
      record[latitude] = text_of(coordinates[1]);
      if (coordinates.size() > 2) record[depth] = text_of(coordinates[2]);
    }
    double milliseconds = 0.0;
    if (text::parse(record[time], milliseconds)) record.at = milliseconds / 86400e3;
    out.add(record, number);
  }
}

/// Columns: date, time of day, type of event, geographic type (not in the yearly files of 2003),
/// magnitude, its type, latitude, longitude, ... The type 'n' says that there is no magnitude.
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
    record[time] = f[0] + ' ' + f[1];
    record[type] = f[2];
    record[magnitude] = f[5] == "n" ? std::string() : f[4];
    record[latitude] = f[6];
    record[longitude] = f[7];
    record[depth] = f[8];
    out.add(record, lines.number);
  }
}

/// Columns: longitude, latitude, year, month, day, magnitude, depth, hour, minute[, second], and
/// others that are not used; NaN for what is missing.
void read_zmap(std::string_view content, Collector &out) {
  constexpr Field columns[] = {longitude, latitude, year, month,  day,
                               magnitude, depth,    hour, minute, second};
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

/// The child `name` of an event whose publicID is given in the element `by`, or the first one.
/// \param found set to false if the file lacks the one that is given
pugi::xml_node preferred(const pugi::xml_node &event, const char *name, const char *by,
                         bool &found) {
  const std::string_view id = text::trim(event.child_value(by));
  for (const pugi::xml_node &one : event.children(name))
    if (!id.empty() && text::trim(one.attribute("publicID").value()) == id) return one;
  if (!id.empty()) found = false;
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
  LineCounter lines{content};
  if (!parsed)
    out.fail(lines.of(parsed.offset), fmt::format("{}, expected QuakeML", parsed.description()));
  Unprefixed walker;
  document.traverse(walker);
  const pugi::xml_node events = document.document_element().child("eventParameters");
  if (!events) throw FileError(path + ": no element eventParameters, expected QuakeML");
  for (const pugi::xml_node &event : events.children("event")) {
    bool found = true;
    const pugi::xml_node origin = preferred(event, "origin", "preferredOriginID", found);
    const pugi::xml_node size = preferred(event, "magnitude", "preferredMagnitudeID", found);
    const auto value = [](const pugi::xml_node &of, const char *name) {
      return text::trim(of.child(name).child_value("value"));
    };
    Record record;
    record[time] = value(origin, "time");
    record[latitude] = value(origin, "latitude");
    record[longitude] = value(origin, "longitude");
    record[magnitude] = value(size, "mag");
    record[type] = text::trim(event.child_value("type"));
    record[depth] = value(origin, "depth");
    record.depth_per_km = 1000.0;
    if (!found) out.add_unpreferred();
    out.add(record, lines.of(event.offset_debug()));
  }
}

std::string_view without_mark(std::string_view content) {
  return content.substr(content.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0);
}

}  // namespace

bool Region::contains(const Earthquake &event) const {
  if (!(event.latitude >= south && event.latitude <= north)) return false;
  if (east - west >= 360.0) return true;
  // 245.9 is -114.1, but for rounding.
  constexpr double rounding = 1e-9;
  const auto eastwards = [this](double longitude) {
    const double turn = std::fmod(longitude - west + rounding, 360.0);
    return turn < 0.0 ? turn + 360.0 : turn;
  };
  return eastwards(event.longitude) <= eastwards(east) + rounding;
}

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
           text::parse(rest.substr(0, slash), v[i]);
    rest.remove_prefix(slash == std::string_view::npos ? rest.size() : slash + 1);
  }
  if (!good || !(v[2] < v[3]) || std::fabs(v[2]) > 90.0 || std::fabs(v[3]) > 90.0 ||
      std::fabs(v[0]) > 360.0 || std::fabs(v[1]) > 360.0 || v[0] == v[1] || v[0] - v[1] >= 360.0)
    throw std::invalid_argument("--region " + text::in_quotes(text) +
                                ", expected W/E/S/N in degrees, such as -122/-114/32/37");
  return {v[0], v[1], v[2], v[3]};
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

EarthquakeList read_earthquakes(std::string_view content, const std::string &format,
                                const std::string &path, bool lenient) {
  Collector out(path, lenient);
  content = without_mark(content);
  if (files::is_utf16(content)) throw FileError(path + files::utf16_text);
  if (content.substr(0, (1 << 16)).find('\0') != std::string_view::npos)
    throw FileError(path + ": has bytes of 0, expected text");
  if (format == "csv") read_columns(content, out);
  if (format == "geojson") read_geojson(content, out);
  if (format == "quakeml") read_quakeml(content, out, path);
  if (format == "zmap") read_zmap(content, out);
  if (format == "scedc") read_scedc(content, out);
  return out.finish();
}

}  // namespace LSM::postproc
