// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "files/file_error.h"
#include "files/text.h"
#include "magnitudes.h"

namespace LSM::postproc {

namespace {

/// Whether a type says that an event is no earthquake: names of QuakeML and ComCat, the codes of
/// SCEDC and NCEDC, and those of ISC and EMSC (IMS 1.0). What only may be something else is none of
/// these: unknown, not reported, other event, induced events (rock bursts are among them), and
/// everything that is not listed, such as the types of magnitudes in a column TYPE, and VT, which
/// stands for earthquakes at volcanoes (volcano-tectonic) as well as for tremor.
bool is_no_earthquake(std::string_view type) {
  static const std::set<std::string, std::less<>> codes = {
      "qb", "sn", "nt", "th", "sh", "px", "bc", "ce", "co", "df", "ls", "rs",  // SCEDC, NCEDC
      "av", "ex", "su", "ve", "km", "sm", "kh", "kx", "sx", "kn"};
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

/// Degrees with a sign, or followed by N, S, E or W.
bool parse_degrees(std::string_view text, double &value) {
  const auto at = std::string_view("NESW").find(text.empty() ? ' ' : text.back());
  if (at == std::string_view::npos) return text::parse(text, value);
  if (!text::parse(text::trim(text.substr(0, text.size() - 1)), value) || value < 0.0) return false;
  if (at >= 2) value = -value;
  return true;
}

/// Whether a number stands for no magnitude: all nines, such as 99.9 or -9.99, or below all
/// magnitudes.
bool stands_for_none(std::string_view text) {
  double value = 0.0;
  if (!text::parse(text, value)) return false;
  if (text.find('.') != std::string_view::npos)
    text = text.substr(0, text.find_last_not_of('0') + 1);
  const bool nines = text.find_first_not_of("+-.9") == std::string_view::npos;
  return value <= -9.0 || (nines && value >= 9.9);
}

}  // namespace

void Collector::add(const Record &record, std::int64_t line) {
  Earthquake event;
  const auto number = [&](Field field, const char *name, double most, double &value) {
    const std::string &text = record[field];
    if (field != Field::magnitude && is_missing(text)) {
      value = NAN;
      return true;
    }
    const bool good =
        field == Field::magnitude ? text::parse(text, value) : parse_degrees(text, value);
    if (good && std::fabs(value) <= most) return true;
    const bool comma = text.find(',') != std::string::npos;
    bad(line, fmt::format("{} is {}, expected a number{}", name, text::in_quotes(text),
                          comma ? " with a decimal point" : ""));
    return false;
  };
  if (is_no_earthquake(record[Field::type])) {
    ++list_.others[record[Field::type]];
    return;
  }
  if (!record.has_origin) {
    ++list_.without_origin;
    return;
  }
  if (!record.at)
    return bad(
        line, fmt::format("time is {}, expected {}", text::in_quotes(record.time),
                          record.problem.empty() ? "a date and time such as 1994-01-17T12:30:55.39Z"
                                                 : record.problem));
  event.time = *record.at;
  if (!number(Field::latitude, "latitude", 90.0, event.latitude) ||
      !number(Field::longitude, "longitude", 360.0, event.longitude))
    return;
  const std::string &size = record[Field::magnitude];
  if (is_missing(size)) {
    ++list_.without_magnitude;
  } else if (stands_for_none(size)) {
    ++list_.fillers[size];
  } else if (number(Field::magnitude, "magnitude", 12.0, event.magnitude)) {
    event.magnitude = as_typed(event.magnitude);
    zeros_with_others_ += event.magnitude == 0.0 && record.other_magnitude >= 0.5;
    list_.events.push_back(event);
  }
}

/// Leaves out the events of the smallest magnitude if it stands for none: 0 or a negative whole
/// number that is not near any other, and that several events have, or one with another magnitude.
void Collector::leave_out_fillers() {
  std::map<double, std::int64_t> counts;
  for (const Earthquake &event : list_.events) ++counts[event.magnitude];
  if (counts.empty()) return;
  const auto [least, count] = *counts.begin();
  if (least > 0.0 || least != std::floor(least)) return;
  const double gap = counts.size() > 1 ? std::next(counts.begin())->first - least : 12.0;
  const auto others = static_cast<std::int64_t>(list_.events.size()) - count;
  const bool beside = least == 0.0 && zeros_with_others_ > 0 && gap >= 0.2;
  if (!beside && !(count >= 3 && others >= 20 && gap >= 1.0)) return;
  list_.fillers[text::number(least)] += count;
  list_.events.erase(
      std::remove_if(list_.events.begin(), list_.events.end(),
                     [least = least](auto &event) { return event.magnitude == least; }),
      list_.events.end());
  leave_out_fillers();
}

void Collector::fail(std::int64_t line, const std::string &what) const {
  throw FileError(where(line) + what);
}

void Collector::bad(std::int64_t line, const std::string &what) {
  if (!lenient_) fail(line, what);
  if (list_.bad_lines++ == 0) list_.first_problem = where(line) + what;
}

EarthquakeList Collector::finish() {
  leave_out_fillers();
  std::int64_t others = 0;
  std::string types;
  for (const auto &[name, count] : list_.others) {
    others += count;
    types +=
        fmt::format("{}{} of type {}", types.empty() ? "" : ", ", count, text::in_quotes(name));
  }
  auto all = others + list_.without_magnitude + list_.without_origin +
             static_cast<std::int64_t>(list_.events.size());
  for (const auto &[text, count] : list_.fillers) all += count;
  if (2 * others > all && !lenient_)
    throw FileError(fmt::format(
        "{}: {} of {} events are no earthquakes ({}), expected less than half; --lenient leaves "
        "them out",
        path_, others, all, types));
  std::stable_sort(list_.events.begin(), list_.events.end(),
                   [](const Earthquake &a, const Earthquake &b) { return a.time < b.time; });
  return std::move(list_);
}

std::string Collector::where(std::int64_t number) const {
  return unit_.empty() ? text::where(path_, number)
                       : fmt::format("{}: {} {}: ", path_, unit_, number);
}

}  // namespace LSM::postproc
