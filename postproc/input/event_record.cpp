// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "files/text.h"

namespace LSM::postproc {

namespace {

using Part = TimeParts::Part;

/// What a column is for: a part of the time, a text (a date, a time of day, or both), a field, ...
enum Role {
  of_text = Part::number_of_parts,
  of_date,
  of_decimal_year,
  of_zone,
  of_rest,  // of a time, not read
  of_other_magnitude,
  of_field  // and those after it
};
constexpr int role_of_field(Field field) { return of_field + static_cast<int>(field); }

/// Names of columns and of properties in GeoJSON: in small letters, without blanks, signs and
/// units, and without what is said of a time in general (origin, UTC). The first one of a field
/// that a file has counts. Those in the second list count only next to a column of the part before
/// or after: Mo may be a moment, Se an error.
constexpr struct {
  int role;
  std::string_view names, short_names = {};
} known_columns[] = {
    {of_text,
     "time datetime dateandtime timestamp timestring timestr isotime clock timeofday hhmm hrmn "
     "hhmmss hms hm hourminute hourmin hourminutesecond hourminsec iso8601 ot otime hora"},
    {of_date,
     "date datestr datestring isodate yyyymmdd ymd yearmonthday ddmmyyyy mmddyyyy fecha tgl"},
    {Part::year, "year yr yyyy ano anio anno annee anne jahr", "y yy ye ao"},
    {Part::month, "month mon mes mese mois monat", "mo mm m mn"},
    {Part::day, "day dom dayofmonth dia giorno jour", "dy da dd d tag"},
    {Part::hour, "hour hours hr hrs hh ora heure stunde", "ho h hou"},
    {Part::minute, "minute minutes minu mins min mnt minuto minutos minuti", "mn mi mm m"},
    {Part::second,
     "second seconds sec secs segundo segundos seg secondi secondo seconde secondes sekunde "
     "sekunden sek",
     "se ss sss ssss s sc"},
    {of_decimal_year, "decimalyear decyear dyear yeardecimal yeardec fractionalyear decimaldate"},
    {of_zone, "timezone tz utcoffset tzoffset timezoneoffset"},
    {of_rest,
     "ampm meridian meridiem decisecond centisecond centiseconds hundredths millisecond "
     "milliseconds msec msecs millis microsecond microseconds usec"},
    {role_of_field(Field::latitude), "latitude lat latitud"},
    {role_of_field(Field::longitude), "longitude lon long lng longitud"},
    {role_of_field(Field::magnitude), "mag magnitude mw magnitud"},
    {role_of_field(Field::type), "eventtype evtype etype type"},
    {of_other_magnitude,
     "mag magnitude mw mww mwc mwb mwr mwp ml mlv md mc mh mb mblg ms mj me xm"}};

/// What a word stands for, and where it is in its list.
struct Meaning {
  int role;
  std::size_t position;
};
using Meanings = std::multimap<std::string, Meaning, std::less<>>;

Meanings meanings_of(bool short_names) {
  Meanings out;
  for (const auto &known : known_columns) {
    const Fields words = split_blanks(short_names ? known.short_names : known.names);
    for (std::size_t i = 0; i < words.size(); ++i) out.insert({words[i], {known.role, i}});
  }
  return out;
}
const Meanings all_names = meanings_of(false), all_short_names = meanings_of(true);

/// The first role of a name for which a condition holds.
template <class Condition>
std::optional<Meaning> find(const Meanings &names, std::string_view name, Condition &&holds) {
  for (auto [at, end] = names.equal_range(name); at != end; ++at)
    if (holds(at->second.role)) return at->second;
  return {};
}

std::string plain(std::string_view text) {
  std::string out;
  for (const char c : in_small_letters(text))
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z')) out += c;
  return out;
}

std::string_view without_unit(std::string_view name) {
  return name.substr(0, name.find_first_of("(/["));
}

bool says_utc(const std::string &name) {
  return name.find("utc") != name.npos || name.find("gmt") != name.npos;
}

/// A plain name without what precedes or follows the part of a time that it is for.
std::string bare(std::string name) {
  if (name == "utc" || name == "gmt" || name == "ut" || name == "origin") return "time";
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view word :
         {"origin", "orig", "event", "earthquake", "quake", "eq", "utc", "gmt", "ut", "of"}) {
      if (name.size() <= word.size()) continue;
      const bool first = name.compare(0, word.size(), word) == 0;
      const bool last = name.compare(name.size() - word.size(), word.size(), word) == 0;
      if (!first && !last) continue;
      name.erase(first ? 0 : name.size() - word.size(), word.size());
      again = true;
    }
  }
  return name;
}

/// The role in a time of a name with its unit, as in Date/Time and yyyy-mm-dd, or without, as in
/// Time (hhmmss.ss). Times in other zones, as in Time (JST), have none.
std::optional<int> time_role(std::string_view name) {
  const std::string_view without = without_unit(name);
  const std::string_view unit = name.substr(std::min(without.size() + 1, name.size()));
  const std::string inside = plain(unit.substr(0, unit.find_first_of(")]")));
  std::vector<std::string> names = {plain(name)};
  static const std::set<std::string> units = {"utc", "gmt", "ut", "sec", "seconds", "min"};
  if (inside.find_first_not_of("ymdhs") == inside.npos || units.count(inside) > 0)
    names.push_back(plain(without));
  for (std::string one : names) {
    for (const char *pattern : {"hhmmss", "yyyymmdd", "ddmmyyyy", "mmddyyyy"})
      if (one.rfind(pattern, 0) == 0) one = pattern;
    const auto of_time = [](int role) { return role < of_other_magnitude; };
    for (const std::string &name_or_part : {one, bare(one)})
      if (const auto known = find(all_names, name_or_part, of_time)) return known->role;
  }
  return {};
}

/// The role of a short name between two others: that of a part next to it in a time.
std::optional<int> role_between(int before, std::string_view name, int after) {
  const auto beside = [](int role, int part) {
    if (role == of_date) role = Part::day;
    return role >= 0 && role < Part::number_of_parts &&
           (std::abs(role - part) == 1 || (part == Part::hour && role < part));
  };
  const auto known = find(all_short_names, plain(without_unit(name)),
                          [&](int role) { return beside(before, role) || beside(after, role); });
  return known ? std::optional(known->role) : std::nullopt;
}

std::optional<double> decimal_year(std::string_view text) {
  double year = 0.0;
  const bool good = text::parse(text, year) && year >= 100.0 && year < 10000.0;
  return good ? std::optional(year) : std::nullopt;
}

}  // namespace

std::string in_small_letters(std::string_view text) {
  std::string out(text);
  for (char &c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool is_missing(std::string_view text) {
  static const std::set<std::string, std::less<>> words = {"",    "nan", "null", "none", "na",
                                                           "n/a", "-",   "--",   "---"};
  return text.size() <= 4 && words.count(in_small_letters(text)) > 0;
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

Columns::Columns(const Fields &names) {
  for (const std::string &name : names) roles_.push_back(time_role(name).value_or(no_role));
  // A time of day beside a column of minutes is the hour: hora, minuto.
  if (has(Part::minute) && !has(Part::hour))
    for (std::size_t i = 0; i < names.size(); ++i)
      if (plain(names[i]) == "hora") roles_[i] = Part::hour;
  // Short names from the left, then from the right, as one may be known by the one beside it.
  const auto try_short = [&](std::size_t i) {
    if (roles_[i] == no_role)
      roles_[i] = role_between(i > 0 ? roles_[i - 1] : no_role, names[i],
                               i + 1 < names.size() ? roles_[i + 1] : no_role)
                      .value_or(no_role);
  };
  for (std::size_t i = 0; i < names.size(); ++i) try_short(i);
  for (std::size_t i = names.size(); i-- > 0;) try_short(i);
  for (std::size_t i = 0; i < names.size(); ++i) {
    // Beside a column of the same name in UTC, one is in another zone: hora, hora UTC.
    const std::string name = plain(names[i]);
    const bool local =
        !says_utc(name) && std::any_of(names.begin(), names.end(), [&](const std::string &other) {
          return says_utc(plain(other)) && bare(plain(other)) == bare(name);
        });
    if (roles_[i] == no_role || local) continue;
    times_.push_back({i, roles_[i], names[i]});
    if (roles_[i] == of_text || roles_[i] == of_date) style_.learn_name(names[i]);
  }
  std::stable_sort(times_.begin(), times_.end(), [](const TimeColumn &a, const TimeColumn &b) {
    const auto rank = [](int role) { return role == of_text ? -2 : role == of_date ? -1 : role; };
    return rank(a.role) < rank(b.role);
  });
  // Of each field, the column whose name comes first in the list.
  std::set<std::tuple<int, std::size_t, std::size_t>> fields;
  const auto look_up = [&](std::size_t i, auto &&condition) {
    return roles_[i] == no_role ? find(all_names, plain(without_unit(names[i])), condition)
                                : std::nullopt;
  };
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto field = look_up(i, [](int role) { return role >= of_field; }))
      fields.insert({field->role, field->position, i});
  for (const auto &[role, position, column] : fields)
    if (!has(role)) roles_[column] = role;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (look_up(i, [](int role) { return role == of_other_magnitude; }))
      roles_[i] = of_other_magnitude;
}

bool Columns::has(int role) const {
  return std::find(roles_.begin(), roles_.end(), role) != roles_.end();
}

Fields Columns::missing() const {
  Fields out;
  if (!has(of_text) && !has(of_date) && !has(of_decimal_year) && !has(Part::year))
    out.push_back("time");
  if (!has(role_of_field(Field::latitude))) out.push_back("latitude");
  if (!has(role_of_field(Field::longitude))) out.push_back("longitude");
  if (!has(role_of_field(Field::magnitude))) out.push_back("mag");
  return out;
}

std::string Columns::time_texts(const Fields &values) const {
  std::string all;
  for (std::size_t i = 0; i < roles_.size(); ++i)
    if (uses(i) && roles_[i] < of_other_magnitude && !is_missing(text::trim(values[i])))
      all += (all.empty() ? "" : " ") + std::string(text::trim(values[i]));
  return all;
}

bool Columns::has_time(const Fields &values) const {
  return time_texts(values).find_first_of("0123456789") != std::string::npos;
}

std::string_view Columns::first_time(const Fields &values) const {
  return times_.empty() ? std::string_view() : text::trim(values[times_.front().at]);
}

void Columns::learn(const Fields &values) {
  std::optional<double> year;
  double value = 0.0;
  for (const TimeColumn &column : times_)
    if (column.role == Part::year && text::parse(text::trim(values[column.at]), value))
      year = value;
  for (const TimeColumn &column : times_) {
    const std::string_view text = text::trim(values[column.at]);
    if (column.role == of_text || column.role == of_date) style_.learn_date(text);
    if (column.role == of_text) style_.learn_clock(text, year);
  }
}

std::optional<double> Columns::time_of(const Fields &values, std::string &problem) const {
  TimeParts known;
  std::optional<double> in_years;
  double unit = 1.0;  // of its last digit, in days
  for (const TimeColumn &column : times_) {
    const std::string_view text = text::trim(values[column.at]);
    if (is_missing(text)) continue;
    TimeParts parts;
    double value = 0.0;
    const bool is_number = text::parse(text, value);
    const bool is_text = column.role == of_text || column.role == of_date;
    if (column.role == of_decimal_year || (is_text && is_number && style_.is_year()) ||
        (column.role == Part::year && value != std::floor(value))) {
      in_years = decimal_year(text);
      const std::size_t point = std::min(text.find('.'), text.size() - 1);
      unit = 366.0 * std::pow(10.0, -static_cast<double>(text.size() - point - 1));
      if (!in_years) {
        problem = "a year of four digits";
        return {};
      }
      if (column.role == Part::year) parts[Part::year] = std::floor(value);
    } else if (is_text) {
      const std::optional<TimeParts> found = style_.parse(text, column.role == of_date, problem);
      if (!found) return {};
      parts = *found;
    } else if (column.role == of_zone) {
      if (text != "0" && !parts.add_zone(text, problem)) return {};
    } else if (column.role == of_rest) {
      problem = "no column " + column.name + ", which is not read";
      return {};
    } else if (is_number) {
      parts[static_cast<std::size_t>(column.role)] = value;
    } else if (const auto month = month_of(text); month && column.role == Part::month) {
      parts[Part::month] = month;
    } else if (known[static_cast<std::size_t>(column.role)]) {
      continue;  // such as the name of a weekday
    } else {
      if (text.find(',') != text.npos) problem = "a decimal point";
      return {};
    }
    if (!known.add(parts)) {
      problem = fmt::format("the same time in the column {} as in those before",
                            text::in_quotes(column.name));
      return {};
    }
  }
  // The parts of a decimal year alone are not yet known; beside others it repeats them.
  const bool only_year = std::none_of(known.values.begin() + 1, known.values.end(),
                                      [](const auto &part) { return part.has_value(); });
  if (in_years && only_year) return days_of_year(*in_years);
  const std::optional<double> at = known.days(problem);
  if (at && known[Part::hour] && !known[Part::minute] && !has(Part::minute)) {
    problem = "a column of minutes next to that of hours";
    return {};
  }
  if (!at || known[Part::hour]) return at;
  for (std::size_t i = 0; i < values.size() && i < roles_.size(); ++i) {
    std::string ignored;
    if (!uses(i) && values[i].find(':') != std::string::npos &&
        style_.parse(text::trim(values[i]), false, ignored)) {
      problem = "a name such as time for the column of " + text::in_quotes(values[i]);
      return {};
    }
  }
  if (!in_years) return at;
  const double exact = days_of_year(*in_years);
  if (exact < *at - unit || exact > *at + 1.0 + unit) {
    problem = fmt::format("a decimal year on the day, not {}", *in_years);
    return {};
  }
  return unit < 0.5 ? exact : at;
}

Record Columns::record_of(const Fields &values) const {
  Record record;
  double other = 0.0;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    const std::string_view text = text::trim(values[i]);
    if (roles_[i] >= of_field) record.texts[static_cast<std::size_t>(roles_[i] - of_field)] = text;
    if (roles_[i] == of_other_magnitude && text::parse(text, other))
      record.other_magnitude = std::max(record.other_magnitude, other);
  }
  record.time = time_texts(values);
  record.at = time_of(values, record.problem);
  return record;
}

}  // namespace LSM::postproc
