// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_time.h"

#include <date/date.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "files/text.h"

namespace LSM::postproc {

namespace {

using Dates = TimeStyle::Dates;
using Digits = TimeStyle::Digits;
using Part = TimeParts::Part;

constexpr std::string_view part_names[] = {"year", "month", "day", "hour", "minute", "second"};
constexpr double year_least = 100.0, year_most = 9999.0;  // two digits: of an unknown century

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// ---- times in text

/// Takes what a condition holds for from the front of a text.
template <class Is>
std::string_view take_while(std::string_view &text, Is &&is) {
  const auto end = std::find_if_not(text.begin(), text.end(), is) - text.begin();
  const std::string_view taken = text.substr(0, static_cast<std::size_t>(end));
  text.remove_prefix(taken.size());
  return taken;
}

bool take(std::string_view &text, std::string_view one_of) {
  if (text.empty() || one_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

double number(std::string_view digits) {
  double value = NAN;
  text::parse(digits, value);
  return value;
}

/// 1 to 12 of the English name of a month, of which three letters are enough.
std::optional<double> month_of(std::string_view name) {
  constexpr std::string_view names[] = {"january",   "february", "march",    "april",
                                        "may",       "june",     "july",     "august",
                                        "september", "october",  "november", "december"};
  const std::string small = in_small_letters(name);
  for (std::size_t i = 0; i < std::size(names); ++i)
    if (small.size() >= 3 && names[i].substr(0, small.size()) == small)
      return static_cast<double>(i + 1);
  return {};
}

/// A date of three numbers, or two and the name of a month.
struct DateText {
  std::array<std::string_view, 3> fields;
  char between = '\0';

  /// Takes a date from the front of a text.
  bool take_from(std::string_view &from) {
    std::string_view text = from;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i > 0) {
        if (text.size() < 2 || std::string_view("-/. ").find(text.front()) == text.npos)
          return false;
        if (i == 2 && text.front() != between) return false;
        between = text.front();
        text.remove_prefix(1);
      }
      const bool letters = !text.empty() && is_letter(text.front());
      fields[i] = letters ? take_while(text, is_letter) : take_while(text, is_digit);
      if (fields[i].empty() || (!letters && fields[i].size() > 4)) return false;
      if (between == ' ' || i == 0 || letters)
        if (text.substr(0, 2) == ", ") text.remove_prefix(1);
    }
    from = text;
    return true;
  }
  static bool is_short(std::string_view field) { return field.size() <= 2 && is_digit(field[0]); }
  bool year_last() const { return fields[2].size() >= 3 && is_digit(fields[2][0]); }
  /// Whether both the day and the month may come first.
  bool is_ambiguous() const { return is_short(fields[0]) && is_short(fields[1]) && year_last(); }
};

bool take_date(std::string_view &text, const TimeStyle &style, TimeParts &parts,
               std::string &problem) {
  std::string_view rest = text;
  std::array<std::string_view, 3> f;  // year, month, day
  DateText date;
  if (date.take_from(rest)) {
    f = date.fields;
    if (date.is_ambiguous()) {
      const bool same = number(f[0]) == number(f[1]);
      if (!same && style.dates == Dates::both)
        problem = "the day first in some dates and the month in others";
      if (!same && style.dates == Dates::not_known)
        problem =
            "a day above 12 somewhere in the file, or a column named dd/mm/yyyy or mm/dd/yyyy, as the "
            "day or the month may come first";
      if (!problem.empty()) return false;
      const bool month_first = style.dates == Dates::month_first;
      f = {f[2], f[month_first ? 0 : 1], f[month_first ? 1 : 0]};
    } else if (date.year_last()) {
      const bool name_first = is_letter(f[0][0]);
      f = {f[2], f[name_first ? 0 : 1], f[name_first ? 1 : 0]};
    } else if (f[0].size() < 3 && date.between == ' ') {
      return false;  // hours, minutes and seconds
    } else if (f[0].size() < 3 || is_letter(f[0][0])) {
      problem = "a year of four digits";
      return false;
    }
  } else {
    rest = text;
    const std::string_view digits = take_while(rest, is_digit);
    if (digits.size() != 8 && digits.size() != 12 && digits.size() != 14) return false;
    f = {digits.substr(0, 4), digits.substr(4, 2), digits.substr(6, 2)};
    rest = text.substr(8);
    if (digits.size() == 8 && !rest.empty() && rest.front() == '.') return false;
  }
  if (f[2].size() > 2 || !is_digit(f[2][0])) return false;
  parts[Part::year] = number(f[0]);
  parts[Part::month] = is_letter(f[1][0]) ? month_of(f[1]) : number(f[1]);
  parts[Part::day] = number(f[2]);
  text = rest;
  return parts[Part::month].has_value();
}

/// Takes seconds, which may have a sign and a decimal comma.
bool take_second(std::string_view &text, TimeParts &parts) {
  const std::string_view begin = text;
  take(text, "-");
  std::string_view whole = take_while(text, is_digit);
  if (whole.empty() || whole.size() > 2) return false;
  if (!text.empty() && (text[0] == '.' || text[0] == ',')) {
    text.remove_prefix(1);
    take_while(text, is_digit);
  }
  std::string second(begin.substr(0, begin.size() - text.size()));
  std::replace(second.begin(), second.end(), ',', '.');
  parts[Part::second] = number(second);
  return true;
}

/// Takes a time of day from the front of a text: h:mm[:ss[.f]], with blanks instead of colons,
/// hhmm ss.f, or digits.
/// \param whole whether digits have their leading zeros, as after a date
bool take_clock(std::string_view &text, bool whole, const TimeStyle &style, TimeParts &parts,
                std::string &problem) {
  const std::string_view begin = text;
  const std::string_view digits = take_while(text, is_digit);
  const auto set = [&parts](std::string_view hour, std::string_view minute) {
    parts[Part::hour] = number(hour);
    parts[Part::minute] = number(minute);
  };
  if (digits.empty()) return false;
  if (digits.size() <= 2 && text.size() > 1 && (text[0] == ':' || text[0] == ' ') &&
      is_digit(text[1])) {
    const char between = text.front();
    text.remove_prefix(1);
    const std::string_view minute = take_while(text, is_digit);
    if (minute.size() > 2) return false;
    set(digits, minute);
    if (text.size() < 2 || text.front() != between || (between == ' ' && is_letter(text[1])))
      return true;
    text.remove_prefix(1);
    return take_second(text, parts);
  }
  if (digits.size() == 4 && text.size() > 1 && text[0] == ' ' && is_digit(text[1])) {
    set(digits.substr(0, 2), digits.substr(2));
    text.remove_prefix(1);
    return take_second(text, parts);
  }
  if (digits.size() > 6) return false;
  const bool fraction = !text.empty() && text.front() == '.';
  const Digits meant = !whole               ? style.digits
                       : digits.size() == 6 ? Digits::hhmmss
                       : digits.size() == 4 ? Digits::hhmm
                                            : Digits::not_known;
  const std::string all = std::string(6 - digits.size(), '0') + std::string(digits);
  if (meant == Digits::hhmmss) {
    set(std::string_view(all).substr(0, 2), std::string_view(all).substr(2, 2));
    text = begin.substr(digits.size());
    std::string_view rest = text;
    if (fraction) {
      rest.remove_prefix(1);
      take_while(rest, is_digit);
    }
    parts[Part::second] =
        number(all.substr(4) + std::string(text.substr(0, text.size() - rest.size())));
    text = rest;
    return true;
  }
  if (meant == Digits::hhmm && digits.size() <= 4 && !fraction) {
    set(std::string_view(all).substr(2, 2), std::string_view(all).substr(4));
    return true;
  }
  if (meant == Digits::hours && digits.size() <= 2 && !fraction) {
    parts[Part::hour] = number(digits);
    return true;
  }
  if (meant == Digits::both)
    problem = "either hhmm or hhmmss in the whole file";
  else if (!whole && (text.empty() || fraction))
    problem = "hhmm, hhmmss or hh:mm:ss";
  return false;
}

/// Takes what may follow a time of day: AM or PM, and a time zone.
bool take_zone(std::string_view &text, TimeParts &parts, std::string &problem) {
  take_while(text, [](char c) { return c == ' '; });
  std::string_view rest = text;
  std::string word = in_small_letters(take_while(rest, is_letter));
  if (word == "am" || word == "pm") {
    if (!(parts[Part::hour] >= 1.0 && parts[Part::hour] <= 12.0)) {  // no hour: less than any
      problem = "an hour from 1 to 12 with AM or PM";
      return false;
    }
    *parts[Part::hour] = std::fmod(*parts[Part::hour], 12.0) + (word == "pm" ? 12.0 : 0.0);
    take_while(rest, [](char c) { return c == ' '; });
    text = rest;
    word = in_small_letters(take_while(rest, is_letter));
  }
  if (!word.empty() && word != "z" && word != "utc" && word != "gmt" && word != "ut") {
    problem = "UTC or a time zone such as +09:00";
    return false;
  }
  if (!word.empty()) parts.ahead = 0;
  text = rest;
  if (text.empty()) return true;
  const bool behind = text.front() == '-';
  if (!take(text, "+-")) return false;
  const std::string_view digits = take_while(text, is_digit);
  std::string_view minutes = digits.substr(std::min<std::size_t>(2, digits.size()));
  if (digits.empty() || (digits.size() != 4 && digits.size() > 2)) return false;
  if (take(text, ":")) minutes = take_while(text, is_digit);
  const double ahead =
      60.0 * number(digits.substr(0, 2)) + (minutes.empty() ? 0.0 : number(minutes));
  if (!(ahead <= 1440.0)) return false;
  parts.ahead = static_cast<int>(behind ? -ahead : ahead);
  return text.empty();
}

/// The parts that a text has: a date, a time of day or both.
bool parse_parts(std::string_view text, const TimeStyle &style, TimeParts &parts,
                 std::string &problem) {
  text = text::trim(text);
  const std::string_view all = text;
  const bool date = take_date(text, style, parts, problem);
  if (!problem.empty()) return false;
  if (!date) {
    parts = {};
    text = all;
  }
  if (date && text.empty()) return true;
  const bool digits = date && is_digit(text.front());  // YYYYMMDDhhmmss
  if (date && !digits) {
    if (!take(text, "Tt ,_-")) return false;
    take_while(text, [](char c) { return c == ' '; });
  }
  return take_clock(text, date, style, parts, problem) && take_zone(text, parts, problem);
}

/// Whether a text is digits, with or without decimals, that may be more than one time of day.
bool is_digits(std::string_view text) {
  std::string_view rest = text;
  const std::string_view digits = take_while(rest, is_digit);
  if (digits.empty() || digits.size() > 6) return false;
  if (take(rest, ".")) take_while(rest, is_digit);
  return rest.empty();
}

/// The style of texts that mean two things, from all of them in a file.
class StyleFinder {
 public:
  void add(std::string_view text, double year) {
    std::string_view rest = text;
    DateText date;
    if (date.take_from(rest) && date.is_ambiguous()) {
      day_first_ = day_first_ || number(date.fields[0]) > 12.0;
      month_first_ = month_first_ || number(date.fields[1]) > 12.0;
    }
    if (!is_digits(text)) return;
    const std::size_t size = std::min(text.find('.'), text.size());
    const bool fraction = size < text.size();
    longest_ = std::max(longest_, size);
    hhmm_ = hhmm_ || (size == 4 && text[0] == '0' && !fraction);
    hhmmss_ = hhmmss_ || size > 4;
    zero_ = zero_ && number(text) == 0.0;
    fraction_ = fraction_ || fraction;
    in_year_ = in_year_ && fraction && std::floor(number(text)) == year;
  }
  /// \param given what the name of the column says
  TimeStyle style(const TimeStyle &given, bool with_minutes) const {
    TimeStyle found;
    const bool day = day_first_ || given.dates == Dates::day_first;
    const bool month = month_first_ || given.dates == Dates::month_first;
    found.dates = day && month ? Dates::both
                  : day        ? Dates::day_first
                  : month      ? Dates::month_first
                               : Dates::not_known;
    const bool four = hhmm_ || given.digits == Digits::hhmm;
    const bool six = hhmmss_ || given.digits == Digits::hhmmss;
    if (longest_ == 0)
      found.digits = given.digits;
    else if (in_year_)
      found.digits = Digits::year;
    else if (four || six)
      found.digits = four && six ? Digits::both : four ? Digits::hhmm : Digits::hhmmss;
    else if (longest_ <= 2 && with_minutes && !fraction_)
      found.digits = Digits::hours;
    else if (zero_)
      found.digits = Digits::hhmmss;
    else if (longest_ > 2 && !fraction_)
      found.digits = Digits::hhmm;
    return found;
  }

 private:
  bool day_first_ = false, month_first_ = false, hhmm_ = false, hhmmss_ = false, fraction_ = false,
       in_year_ = true, zero_ = true;
  std::size_t longest_ = 0;
};

// ---- times of parts

/// Days since 1970 of the parts, of which those up to the day are known.
/// \param problem says what is impossible
std::optional<double> days_of(const TimeParts &parts, std::string &problem) {
  // What is out of its unit carries over, as in 23:59:60 and 04:60:61.33, but 99 is no second.
  constexpr double least[] = {year_least, 1, 1, 0, 0, -60},
                   most[] = {year_most, 12, 31, 24, 60, 90};
  std::array<double, Part::number_of_parts> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = parts.values[i].value_or(0.0);
    if (v[i] >= least[i] && v[i] <= most[i] && (i == Part::second || v[i] == std::floor(v[i])))
      continue;
    problem =
        fmt::format("a {} from {} to {} instead of {}", part_names[i], least[i], most[i], v[i]);
    return {};
  }
  const date::year_month_day when{date::year(static_cast<int>(v[Part::year])),
                                  date::month(static_cast<unsigned>(v[Part::month])),
                                  date::day(static_cast<unsigned>(v[Part::day]))};
  if (!when.ok()) {
    problem = "a day that the month has";
    return {};
  }
  const auto whole = static_cast<double>(date::sys_days(when).time_since_epoch().count());
  return whole + (v[Part::hour] * 3600.0 + v[Part::minute] * 60.0 + v[Part::second]) / 86400.0 -
         parts.ahead.value_or(0) / 1440.0;
}

/// Days since 1970 of a year with a fraction.
double days_of_year(double year) {
  const auto begin = [](double of) {
    return static_cast<double>(
        date::sys_days(date::year(static_cast<int>(of)) / 1 / 1).time_since_epoch().count());
  };
  const double whole = std::floor(year);
  return begin(whole) + (year - whole) * (begin(whole + 1.0) - begin(whole));
}

/// Adds the parts of another column, which must agree with those that are known.
bool merge(TimeParts &known, const TimeParts &other, std::string_view name, std::string &problem) {
  constexpr double tolerance[] = {0.5, 0.5, 0.5, 0.5 / 24, 1.0 / 1440, 1.0 / 86400};
  TimeParts filled = known, replaced = known;
  std::size_t finest = 0;
  bool both = false;
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    if (!other.values[i]) continue;
    finest = i;
    both = both || known.values[i];
    replaced.values[i] = other.values[i];
    if (!filled.values[i]) filled.values[i] = other.values[i];
  }
  if (other.ahead) replaced.ahead = other.ahead;
  if (!known[Part::hour]) filled.ahead = other.ahead;
  if (both && filled[Part::year] && filled[Part::month] && filled[Part::day]) {
    std::string ignored;
    for (std::size_t i = 0; i < filled.values.size(); ++i)
      if (!replaced.values[i]) replaced.values[i] = filled.values[i];
    if (!known[Part::hour]) replaced.ahead = filled.ahead;
    const auto a = days_of(filled, problem), b = days_of(replaced, ignored);
    if (!a) return false;
    if (!b || !(std::fabs(*a - *b) <= tolerance[finest] * (1.0 + 1e-6))) {
      problem =
          fmt::format("the same time in the column {} as in those before", text::in_quotes(name));
      return false;
    }
  }
  known = filled;
  return true;
}

// ---- names of columns

/// What a column is for: a part of the time, a text (a date, a time of day, or both), ...
enum Role {
  of_part = 0,
  of_text = Part::number_of_parts,
  of_date,
  of_decimal_year,
  of_day_of_year,
  of_millisecond,
  of_microsecond,
  of_zone,
  of_rest,
  no_role
};

/// Names of columns in small letters, without blanks and signs, and without what is said of a time
/// in general (origin, UTC). Those in the second list count only next to a column of the part
/// before or after: Mo may be a moment, Se an error.
constexpr struct {
  int role;
  std::string_view names, short_names;
} known_columns[] = {
    {of_text,
     "time datetime dateandtime timestamp timestring timestr isotime clock timeofday hhmm hrmn "
     "hhmmss hms hm hourminute hourmin hourminutesecond hourminsec iso8601 ot otime hora",
     ""},
    {of_date,
     "date datestr datestring isodate yyyymmdd ymd yearmonthday ddmmyyyy dmy daymonthyear mmddyyyy "
     "mdy monthdayyear fecha tgl",
     ""},
    {Part::year, "year yr yyyy ano anio anno annee anne jahr", "y yy ye ao"},
    {Part::month, "month mon mes mese mois monat", "mo mm m mn"},
    {Part::day, "day dom dayofmonth dia giorno jour", "dy da dd d tag"},
    {Part::hour, "hour hours hr hrs hh ora heure stunde", "ho h hou"},
    {Part::minute, "minute minutes minu mins min mnt minuto minutos minuti", "mn mi mm m"},
    {Part::second,
     "second seconds sec secs segundo segundos seg secondi secondo seconde secondes sekunde "
     "sekunden sek",
     "se ss sss ssss s sc"},
    {of_decimal_year, "decimalyear decyear dyear yeardecimal yeardec fractionalyear decimaldate",
     ""},
    {of_day_of_year, "dayofyear doy jday julianday julday yday", ""},
    {of_millisecond, "millisecond milliseconds msec msecs millis", ""},
    {of_microsecond, "microsecond microseconds usec", ""},
    {of_zone, "timezone tz utcoffset tzoffset timezoneoffset", ""},
    {of_rest, "ampm meridian meridiem centisecond centiseconds hundredths decisecond", ""}};

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty() && !word.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

/// A name without what precedes or follows the part of a time that it is for.
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

std::string letters_of(std::string_view text) {
  std::string out;
  for (const char c : in_small_letters(text))
    if (is_digit(c) || is_letter(c)) out += c;
  return out;
}

/// Whether a name says that its times are not in UTC: Time (JST), Date (UTC+3).
bool is_local(std::string_view name) {
  const std::size_t begin = std::min(name.find_first_of("(["), name.size());
  std::string_view zone = name.substr(std::min(begin + 1, name.size()));
  zone = text::trim(zone.substr(0, zone.find_first_of(")]")));
  TimeParts parts;
  std::string ignored;
  if (!zone.empty() && take_zone(zone, parts, ignored)) return parts.ahead.value_or(0) != 0;
  const std::string plain = letters_of(name.substr(begin));
  return plain.find("local") != std::string::npos ||
         has_word(
             "jst kst ist nzst nzdt aest cst est edt cdt mst mdt pst pdt cet cest eet eest trt "
             "msk wib lt",
             plain);
}

int role_of(std::string_view name) {
  if (is_local(name)) return no_role;
  // First with the unit, as in Date/Time and yyyy-mm-dd, then without, as in Time (hhmmss.ss).
  const std::string_view without = name.substr(0, name.find_first_of("(/["));
  for (std::string plain : {letters_of(name), letters_of(without)}) {
    for (const char *pattern : {"hhmmss", "yyyymmdd", "ddmmyyyy", "mmddyyyy"})
      if (plain.rfind(pattern, 0) == 0) plain = pattern;
    for (const auto &known : known_columns)
      if (has_word(known.names, plain) || has_word(known.names, bare(plain))) return known.role;
  }
  return no_role;
}

/// The role of a short name between two others: that of a part next to it in a time.
int role_between(int before, std::string_view name, int after) {
  const std::string plain = letters_of(name.substr(0, name.find_first_of("(/[")));
  const auto beside = [](int larger, int smaller) {
    const bool in_date = larger >= Part::year && larger <= Part::day && smaller >= Part::year &&
                         smaller <= Part::day;
    return (in_date && std::abs(larger - smaller) == 1) ||
           (larger <= Part::minute && larger >= Part::day && smaller == larger + 1) ||
           ((larger == of_date || larger == Part::year || larger == Part::month) &&
            smaller == Part::hour);
  };
  for (const auto &known : known_columns)
    if (has_word(known.short_names, plain) &&
        (beside(before, known.role) || beside(known.role, after)))
      return known.role;
  return no_role;
}

TimeStyle style_of(std::string_view name) {
  const std::string plain = letters_of(name);
  const auto has = [&plain](const char *text) { return plain.find(text) != std::string::npos; };
  TimeStyle style;
  if (has("ddmm") || has("daymonth") || plain == "dmy")
    style.dates = Dates::day_first;
  else if ((has("mmdd") && !has("yymmdd")) || (has("monthday") && !has("yearmonth")) ||
           plain == "mdy")
    style.dates = Dates::month_first;
  if (has("hhmmss") || has("hms") || has("minsec") || has("minutesec"))
    style.digits = Digits::hhmmss;
  else if (has("hhmm") || has("hrmn") || plain == "hm" || has("hourmin"))
    style.digits = Digits::hhmm;
  return style;
}

}  // namespace

TimeColumns::TimeColumns(const Fields &names) : used_(names.size(), false) {
  std::vector<int> roles;
  for (const std::string &name : names) roles.push_back(role_of(name));
  // A time of day beside a column of minutes is the hour: hora, minuto.
  if (std::find(roles.begin(), roles.end(), Part::minute) != roles.end() &&
      std::find(roles.begin(), roles.end(), Part::hour) == roles.end())
    for (std::size_t i = 0; i < names.size(); ++i)
      if (letters_of(names[i]) == "hora") roles[i] = Part::hour;
  // Short names from the left, then from the right, as one may be known by the one beside it.
  const auto is_short = [&](std::size_t i) {
    if (roles[i] != no_role) return;
    roles[i] = role_between(i > 0 ? roles[i - 1] : no_role, names[i],
                            i + 1 < names.size() ? roles[i + 1] : no_role);
  };
  for (std::size_t i = 0; i < names.size(); ++i) is_short(i);
  for (std::size_t i = names.size(); i-- > 0;) is_short(i);
  const auto in_utc = [&](std::size_t i) {
    const std::string plain = letters_of(names[i]);
    return plain.find("utc") != std::string::npos || plain.find("gmt") != std::string::npos;
  };
  for (const int role : {of_text, of_date}) {
    bool utc = false;  // then others of the role are in another zone
    for (std::size_t i = 0; i < names.size(); ++i) utc = utc || (roles[i] == role && in_utc(i));
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (roles[i] != role) continue;
      used_[i] = true;
      if (!utc || in_utc(i)) columns_.push_back({i, role, names[i], style_of(names[i]), false});
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (roles[i] != of_text && roles[i] != of_date && roles[i] != no_role) {
      columns_.push_back({i, roles[i], names[i], {}, false});
      used_[i] = true;
    }
  std::stable_sort(columns_.begin(), columns_.end(), [](const Column &a, const Column &b) {
    const auto rank = [](int role) { return role == of_text ? -2 : role == of_date ? -1 : role; };
    return rank(a.role) < rank(b.role);
  });
}

const TimeColumns::Column *TimeColumns::column_of(int role) const {
  for (const Column &column : columns_)
    if (column.role == role) return &column;
  return nullptr;
}

bool TimeColumns::has_date() const {
  return column_of(of_text) || column_of(of_date) || column_of(of_decimal_year) ||
         column_of(Part::year);
}

std::string TimeColumns::texts(const Fields &values) const {
  std::string all;
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (used_[i] && !is_missing(text::trim(values[i])))
      all += (all.empty() ? "" : " ") + std::string(text::trim(values[i]));
  return all;
}

std::string_view TimeColumns::first_text(const Fields &values) const {
  return columns_.empty() ? std::string_view() : text::trim(values[columns_.front().at]);
}

bool TimeColumns::has_digits(const Fields &values) const {
  const std::string all = texts(values);
  return std::any_of(all.begin(), all.end(), is_digit);
}

void TimeColumns::decide(Column &column) {
  StyleFinder finder;
  const Column *year = column_of(Part::year);
  const auto use = [&](const Fields &values) {
    finder.add(text::trim(values[column.at]), year ? number(text::trim(values[year->at])) : NAN);
  };
  if (for_each_line) for_each_line(use);
  column.style = finder.style(column.style, column_of(Part::minute) != nullptr);
  column.decided = true;
}

std::optional<double> TimeColumns::time_of(const Fields &values, std::string &problem) {
  TimeParts known;
  double decimal_year = NAN, unit = 1.0;  // the unit of its last digit
  const auto is_decimal_year = [&](std::string_view text) {
    const std::size_t point = text.find('.');
    decimal_year = number(text);
    unit = point == text.npos ? 1.0 : std::pow(10.0, -static_cast<double>(text.size() - point - 1));
    return decimal_year >= year_least && decimal_year <= year_most;
  };
  for (Column &column : columns_) {
    const std::string_view text = text::trim(values[column.at]);
    if (is_missing(text)) continue;
    TimeParts parts;
    double value = NAN;
    if (column.role == of_text || column.role == of_date) {
      DateText date;
      std::string_view rest = text;
      if (!column.decided && (is_digits(text) || (date.take_from(rest) && date.is_ambiguous())))
        decide(column);
      if (column.style.digits == Digits::year && is_digits(text)) {
        if (!is_decimal_year(text)) return {};
        continue;
      }
      if (!parse_parts(text, column.style, parts, problem)) return {};
      if (column.role == of_date && !parts[Part::year]) {
        problem = "a date with a year of four digits";
        return {};
      }
    } else if (column.role == of_decimal_year) {
      if (!is_decimal_year(text)) return {};
      continue;
    } else if (column.role == of_zone) {
      std::string_view rest = text;
      if (rest != "0" && (!take_zone(rest, parts, problem) || !rest.empty())) return {};
      if (!known.ahead) known.ahead = parts.ahead;
      continue;
    } else if (column.role == of_rest) {
      problem = "no column " + column.name + ", which is not read";
      return {};
    } else {
      const auto month = column.role == Part::month ? month_of(text) : std::nullopt;
      if (month)
        value = *month;
      else if (!text::parse(text, value)) {
        if (column.role < Part::number_of_parts &&
            known.values[static_cast<std::size_t>(column.role)])
          continue;  // such as the name of a weekday
        if (text.find(',') != text.npos) problem = "a decimal point";
        return {};
      }
      if (column.role == of_millisecond || column.role == of_microsecond) {
        if (!known[Part::second]) {
          problem = "seconds with their fraction";
          return {};
        }
        *known[Part::second] += value * (column.role == of_millisecond ? 1e-3 : 1e-6);
        continue;
      }
      if (column.role == of_day_of_year) {
        if (known[Part::month] || !known[Part::year]) continue;
        const double first = days_of_year(std::floor(*known[Part::year]));
        const auto when =
            date::year_month_day(date::sys_days(date::days(static_cast<int>(first + value - 1.0))));
        if (!(value >= 1.0 && value <= 366.0) || value != std::floor(value) ||
            static_cast<int>(when.year()) != static_cast<int>(*known[Part::year])) {
          problem = "a day of the year";
          return {};
        }
        parts[Part::month] = static_cast<double>(static_cast<unsigned>(when.month()));
        parts[Part::day] = static_cast<double>(static_cast<unsigned>(when.day()));
      } else {
        if (column.role == Part::year && value != std::floor(value)) {
          if (!is_decimal_year(text)) {
            problem = "a year of four digits";
            return {};
          }
          value = std::floor(value);
        }
        parts.values[static_cast<std::size_t>(column.role)] = value;
      }
    }
    if (!merge(known, parts, column.name, problem)) return {};
  }
  // The year of a decimal year alone is not yet known; beside others it repeats them.
  if (!std::isnan(decimal_year) && !known[Part::month] && !known[Part::day] && !known[Part::hour] &&
      !known[Part::minute] && !known[Part::second])
    return days_of_year(decimal_year);
  std::size_t finest = 0;
  for (std::size_t i = 0; i < known.values.size(); ++i)
    if (known.values[i]) finest = i;
  for (std::size_t i = 0; i < std::max<std::size_t>(finest, Part::day); ++i)
    if (!known.values[i]) {
      if (finest > 0)
        problem = fmt::format("the {} as well as the {}", part_names[i], part_names[finest]);
      return {};
    }
  if (!known[Part::day]) return {};
  if (known[Part::hour] && !known[Part::minute] && column_of(Part::hour) &&
      !column_of(Part::minute)) {
    problem = "a column of minutes next to that of hours";
    return {};
  }
  const std::optional<double> at = days_of(known, problem);
  if (!at || known[Part::hour]) return at;
  for (std::size_t i = 0; i < values.size() && i < used_.size(); ++i) {
    std::string_view text = text::trim(values[i]);
    TimeParts parts;
    std::string ignored;
    if (!used_[i] && text.find(':') != text.npos && take_clock(text, true, {}, parts, ignored)) {
      problem = "a name such as time for the column of " + text::in_quotes(values[i]);
      return {};
    }
  }
  if (std::isnan(decimal_year)) return at;
  const double exact = days_of_year(decimal_year), width = unit * 366.0;
  if (exact < *at - width || exact > *at + 1.0 + width) {
    problem = fmt::format("a decimal year on the day, not {}", decimal_year);
    return {};
  }
  return width < 0.5 ? exact : at;
}

std::optional<double> parse_date(std::string_view text, std::string &problem) {
  TimeParts parts;
  if (!parse_parts(text, {}, parts, problem) || !parts[Part::day]) return {};
  return days_of(parts, problem);
}

std::optional<double> parse_date(std::string_view text) {
  std::string ignored;
  return parse_date(text, ignored);
}

std::string date_text(double days) {
  return date::format("%FT%RZ", date::sys_time<std::chrono::minutes>(
                                    std::chrono::minutes(std::llround(days * 1440.0))));
}

}  // namespace LSM::postproc
