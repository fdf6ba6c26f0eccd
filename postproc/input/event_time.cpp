// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_time.h"

#include <date/date.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "files/text.h"

namespace LSM::postproc {

namespace {

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

}  // namespace

std::optional<double> time_in_parts(const Record &record) {
  std::array<double, 6> v{};  // year, month, day, hour, minute, second
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string_view text = record.texts[static_cast<std::size_t>(Field::year) + i];
    if (!text::parse(text, v[i]) && !(i >= 3 && is_missing(text))) return {};
    if (i > 0 && i < 5 && (v[i] < 0.0 || v[i] > 60.0 || v[i] != std::floor(v[i]))) return {};
  }
  if (!(v[0] >= 100.0 && v[0] < 1e4)) return {};
  const auto whole = [&v](std::size_t i) { return static_cast<int>(v[i]); };
  const std::string of_day = iso_clock(record[Field::time]);
  if (of_day.empty()) return days(whole(0), whole(1), whole(2), whole(3), whole(4), v[5]);
  return parse_date(fmt::format("{:04}-{:02}-{:02} {}", whole(0), whole(1), whole(2), of_day));
}

std::optional<double> time_of(const Record &record) {
  if (record.at) return record.at;
  if (!record[Field::date].empty())
    return parse_date(iso_date(record[Field::date]) +
                      (is_missing(record[Field::time]) ? "" : " " + record[Field::time]));
  const std::optional<double> at = parse_date(record[Field::time]);
  return at || record[Field::year].empty() ? at : time_in_parts(record);
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

}  // namespace LSM::postproc
