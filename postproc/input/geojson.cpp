// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "event_time.h"
#include "files/file_error.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

using nlohmann::json;

/// The reason in a message of the library: without its number and place, and without the text that
/// it read last, which may have any bytes.
std::string reason_in(std::string_view message) {
  const std::size_t place = message.find(": ");
  message.remove_prefix(place == message.npos ? message.find("] ") + 2 : place + 2);
  return std::string(message.substr(0, message.find("; last read")));
}

json parsed(std::string_view content, Collector &out) {
  constexpr int deepest = 100;
  const auto depth = [&](int now, json::parse_event_t, json &) {
    if (now > deepest)
      throw FileError(fmt::format("{}: JSON nested more than {} levels deep, expected GeoJSON",
                                  out.path(), deepest));
    return true;
  };
  const auto fail_at = [&](std::size_t byte, const std::string &reason) {
    const std::string_view before = content.substr(0, byte);
    out.fail(1 + std::count(before.begin(), before.end(), '\n'), reason + ", expected GeoJSON");
  };
  try {
    return json::parse(content, depth);
  } catch (const json::parse_error &error) {
    fail_at(error.byte, reason_in(error.what()));
  } catch (const json::out_of_range &error) {
    const std::string reason = reason_in(error.what());  // number overflow parsing '1e400'
    const std::size_t quote = reason.find('\'') + 1;
    fail_at(content.find(reason.substr(quote, reason.rfind('\'') - quote)), reason);
  }
  return {};
}

}  // namespace

void read_geojson(std::string_view content, Collector &out) {
  const json document = parsed(content, out);
  // Not what an array or object contains, which may be nested.
  const auto text_of = [](const json &value) {
    return value.is_string()       ? value.get<std::string>()
           : value.is_null()       ? std::string()
           : value.is_structured() ? value.type_name()
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
  Fields last_names;
  Columns columns;
  double latest = 0.0;
  for (const json &feature : features) {
    ++number;
    const json &properties = member(feature, "properties");
    const json &coordinates = member(member(feature, "geometry"), "coordinates");
    Fields names, values;
    for (const auto &[name, value] : properties.items()) {
      names.push_back(name);
      values.push_back(text_of(value));
    }
    if (names != last_names) columns = Columns(last_names = names);
    Record record = columns.record_of(values);
    if (double milliseconds = 0.0; text::parse(columns.first_time(values), milliseconds))
      latest = std::max(latest, std::fabs(*(record.at = milliseconds / 86400e3)));
    if (coordinates.is_array() && coordinates.size() >= 2) {
      record[Field::longitude] = text_of(coordinates[0]);
      record[Field::latitude] = text_of(coordinates[1]);
    }
    out.add(record, number);
  }
  // Seconds would be days of January 1970, smaller units the far future.
  constexpr double month = 31.0, last = 3e6;  // days
  if (latest > 0.0 && !(latest > month && latest < last))
    out.fail(
        number,
        fmt::format("all times are within {:.3g} days of 1970, expected milliseconds since 1970",
                    latest));
}

}  // namespace LSM::postproc
