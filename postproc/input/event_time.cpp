// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_time.h"

#include <date/date.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <vector>

#include "event_record.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

using Part = TimeParts::Part;

constexpr std::string_view part_names[] = {"year", "month", "day", "hour", "minute", "second"};
constexpr std::string_view digits = "0123456789";
constexpr double year_least = 100.0, year_most = 9999.0;  // two digits: of an unknown century

// Forms of dates. The first one that fits counts; of the others each text fits one or both.
constexpr const char *date_forms[] = {"%Y-%m-%d", "%Y/%m/%d", "%Y.%m.%d", "%Y%m%d",
                                      "%d.%m.%Y", "%d %b %Y", "%d-%b-%Y", "%b %d, %Y"},
                     *day_first_forms[] = {"%d/%m/%Y", "%d-%m-%Y"},
                     *month_first_forms[] = {"%m/%d/%Y", "%m-%d-%Y"};

/// A date at the front of a text, and what follows it.
struct DateText {
  date::year_month_day day;
  std::string_view rest;
};

template <std::size_t N>
std::optional<DateText> date_in(std::string_view text, const char *const (&forms)[N]) {
  for (const char *const form : forms) {
    std::istringstream in{std::string(text)};
    date::year_month_day day;
    if (date::from_stream(in, form, day).fail() || static_cast<int>(day.year()) < year_least)
      continue;
    const std::size_t end = in.eof() ? text.size() : static_cast<std::size_t>(in.tellg());
    // Without signs all parts have all of their digits.
    if (form != std::string_view("%Y%m%d") || end == 8) return DateText{day, text.substr(end)};
  }
  return {};
}

/// Whether a text is digits, with or without decimals, that may be a time of day.
bool is_number(std::string_view text) {
  const std::size_t point = std::min(text.find_first_not_of(digits), text.size());
  return point > 0 && point <= 6 && text.substr(point, 1) != "," &&
         text.find_first_not_of(digits, point + 1) == text.npos &&
         (point == text.size() || text[point] == '.');
}

}  // namespace

bool TimeParts::add(const TimeParts &others) {
  for (std::size_t i = 0; i < number_of_parts; ++i) {
    const double tolerance = i == second ? 1.0 : 0.0;  // rounded, or without its fraction
    if (values[i] && others[i] && std::fabs(*values[i] - *others[i]) > tolerance) return false;
    if (!values[i]) values[i] = others[i];
  }
  if (ahead && others.ahead && *ahead != *others.ahead) return false;
  if (!ahead) ahead = others.ahead;
  return true;
}

bool TimeParts::add_zone(std::string_view text, std::string &problem) {
  std::string zone = in_small_letters(text::trim(text));
  const auto take = [&zone](std::string_view word) {
    if (zone.compare(0, word.size(), word) != 0) return false;
    zone = text::trim(std::string_view(zone).substr(word.size()));
    return true;
  };
  const bool after_noon = take("pm");
  if (after_noon || take("am")) {
    if (!(values[hour] >= 1.0 && values[hour] <= 12.0)) {  // no hour: less than any
      problem = "an hour from 1 to 12 with AM or PM";
      return false;
    }
    *values[hour] = std::fmod(*values[hour], 12.0) + (after_noon ? 12.0 : 0.0);
  }
  if (take("utc") || take("gmt") || take("ut") || take("z")) ahead = 0.0;
  if (zone.empty()) return true;
  std::string hhmm = zone.substr(1);
  if (hhmm.size() == 5 && hhmm[2] == ':') hhmm.erase(2, 1);
  double number = 0.0;
  if ((zone[0] == '+' || zone[0] == '-') && hhmm.find_first_not_of(digits) == hhmm.npos &&
      (hhmm.size() <= 2 || hhmm.size() == 4) && text::parse(hhmm, number)) {
    const double hours = hhmm.size() == 4 ? std::floor(number / 100.0) : number;
    const double minutes = 60.0 * hours + (hhmm.size() == 4 ? number - 100.0 * hours : 0.0);
    ahead = zone[0] == '-' ? -minutes : minutes;
    if (minutes <= 1440.0) return true;
  }
  problem = "UTC or a time zone such as +09:00";
  return false;
}

std::optional<double> TimeParts::days(std::string &problem) const {
  constexpr double least[] = {year_least, 1, 1, 0, 0, -60},
                   most[] = {year_most, 12, 31, 24, 60, 90};  // 99 is no second
  std::size_t finest = 0;
  for (std::size_t i = 0; i < number_of_parts; ++i)
    if (values[i]) finest = i;
  std::array<double, number_of_parts> v{};
  for (std::size_t i = 0; i < number_of_parts; ++i) {
    if (!values[i] && i < std::max<std::size_t>(finest, day)) {
      if (finest > 0)
        problem = fmt::format("the {} as well as the {}", part_names[i], part_names[finest]);
      return {};
    }
    v[i] = values[i].value_or(0.0);
    if (!values[i] ||
        (v[i] >= least[i] && v[i] <= most[i] && (i == second || v[i] == std::floor(v[i]))))
      continue;
    problem =
        fmt::format("a {} from {} to {} instead of {}", part_names[i], least[i], most[i], v[i]);
    return {};
  }
  const date::year_month_day when{date::year(static_cast<int>(v[year])),
                                  date::month(static_cast<unsigned>(v[month])),
                                  date::day(static_cast<unsigned>(v[day]))};
  if (!when.ok()) {
    problem = "a day that the month has";
    return {};
  }
  const auto whole = static_cast<double>(date::sys_days(when).time_since_epoch().count());
  return whole + (v[hour] * 3600.0 + v[minute] * 60.0 + v[second]) / 86400.0 -
         ahead.value_or(0.0) / 1440.0;
}

double days_of_year(double year) {
  const auto begin = [](double of) {
    return static_cast<double>(
        date::sys_days(date::year(static_cast<int>(of)) / 1 / 1).time_since_epoch().count());
  };
  const double whole = std::floor(year);
  return begin(whole) + (year - whole) * (begin(whole + 1.0) - begin(whole));
}

std::optional<double> month_of(std::string_view name) {
  std::istringstream in{std::string(name)};
  date::month month;
  if (date::from_stream(in, "%b", month).fail()) return {};
  return static_cast<double>(static_cast<unsigned>(month));
}

void TimeStyle::learn_name(std::string_view name) {
  std::string plain;
  std::copy_if(name.begin(), name.end(), std::back_inserter(plain),
               [](unsigned char c) { return std::isalpha(c); });
  plain = in_small_letters(plain);
  const auto has = [&plain](const char *text) { return plain.find(text) != plain.npos; };
  day_first_ = day_first_ || has("ddmm");
  month_first_ = month_first_ || (has("mmdd") && !has("yymmdd"));
  hhmmss_ = hhmmss_ || has("hhmmss");
  hhmm_ = hhmm_ || has("hrmn") || (has("hhmm") && !has("hhmmss"));
}

void TimeStyle::learn_date(std::string_view text) {
  if (text.find_first_of("/-") > 2) return;
  const bool day = date_in(text, day_first_forms).has_value(),
             month = date_in(text, month_first_forms).has_value();
  day_first_ = day_first_ || (day && !month);
  month_first_ = month_first_ || (month && !day);
}

void TimeStyle::learn_clock(std::string_view text, std::optional<double> year) {
  if (!is_number(text)) return;
  const std::size_t size = std::min(text.find('.'), text.size());
  const bool fraction = size < text.size();
  double value = NAN;
  text::parse(text, value);
  digits_ = std::max(digits_, size);
  hhmm_ = hhmm_ || (size == 4 && text[0] == '0' && !fraction);
  hhmmss_ = hhmmss_ || size > 4;
  fraction_ = fraction_ || fraction;
  in_year_ = in_year_ && fraction && std::floor(value) == year;
}

bool TimeStyle::take_date(std::string_view &text, TimeParts &parts, std::string &problem) const {
  std::optional<DateText> found = date_in(text, date_forms);
  if (!found) {
    const auto day_first = date_in(text, day_first_forms),
               month_first = date_in(text, month_first_forms);
    if (day_first && month_first && day_first->day != month_first->day &&
        day_first_ == month_first_)
      problem = day_first_
                    ? "the day first in some dates and the month in others"
                    : "a day above 12 somewhere in the file, or a column named dd/mm/yyyy or "
                      "mm/dd/yyyy, as the day or the month may come first";
    found = day_first && (!month_first || day_first_) ? day_first : month_first;
    if (found && day_first_ && month_first_)
      problem = "the day first in some dates and the month in others";
  }
  if (!found || !problem.empty()) return false;
  parts[Part::year] = static_cast<int>(found->day.year());
  parts[Part::month] = static_cast<unsigned>(found->day.month());
  parts[Part::day] = static_cast<unsigned>(found->day.day());
  text = found->rest;
  return true;
}

/// Takes h:mm[:ss[.f]] from the front of a text, with blanks instead of colons, or without: hhmm,
/// hhmm ss.f, hhmmss.f.
bool TimeStyle::take_clock(std::string_view &text, bool after_date, TimeParts &parts,
                           std::string &problem) const {
  std::string clock(text.substr(0, text.find_first_not_of("0123456789:., ")));
  text.remove_prefix(clock.size());
  clock.resize(clock.find_last_not_of(' ') + 1);
  std::replace(clock.begin(), clock.end(), ',', '.');
  for (char &c : clock)
    if (c == ':' || c == ' ') c = ',';  // between fields
  const std::size_t first = std::min(clock.find_first_not_of(digits), clock.size());
  if (first > 2 || clock.find(',') == clock.npos) {
    const bool point = clock.substr(first, 1) == ".";
    const std::size_t all = after_date || clock.substr(first, 1) == ","              ? first
                            : hhmmss_ || clock.find_first_not_of("0.") == clock.npos ? 6
                            : hhmm_ || (digits_ > 2 && !fraction_)                   ? 4
                                                                                     : 0;
    if (!after_date && hhmm_ && hhmmss_)
      problem = "either hhmm or hhmmss in the whole file";
    else if (text.empty() && (all == 0 || (all == 4 && point)))
      problem = "hhmm, hhmmss or hh:mm:ss";
    if (!problem.empty() || first == 0 || first > all || (all != 4 && all != 6)) return false;
    clock.insert(0, all - first, '0');  // zeros that a program left out
    for (std::size_t at = all; at > 2;) clock.insert(at -= 2, ",");
  }
  std::vector<std::string_view> fields;
  text::split(clock, fields);
  if (fields.size() < 2 || fields.size() > 3) return false;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    double value = 0.0;
    if (!text::parse(fields[i], value)) return false;
    parts[Part::hour + i] = value;
  }
  return true;
}

std::optional<TimeParts> TimeStyle::parse(std::string_view text, bool needs_date,
                                          std::string &problem) const {
  TimeParts parts;
  text = text::trim(text);
  const bool date = take_date(text, parts, problem);
  if (needs_date && !date && problem.empty())
    problem = "a possible date with a year of four digits";
  if (!problem.empty()) return {};
  if (date && text.empty()) return parts;
  if (date) text.remove_prefix(std::min(text.find_first_not_of("Tt ,_-"), text.size()));
  if (!take_clock(text, date, parts, problem) || !parts.add_zone(text, problem)) return {};
  return parts;
}

std::optional<double> parse_date(std::string_view text, std::string &problem) {
  const std::optional<TimeParts> parts = TimeStyle().parse(text, false, problem);
  return parts && (*parts)[Part::day] ? parts->days(problem) : std::nullopt;
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
