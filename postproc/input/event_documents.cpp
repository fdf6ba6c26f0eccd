// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_documents.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "event_time.h"
#include "files/file_error.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

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

}  // namespace

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
  Fields last_names;
  TimeColumns times;
  for (const json &feature : features) {
    ++number;
    const json &properties = member(feature, "properties");
    const json &coordinates = member(member(feature, "geometry"), "coordinates");
    Fields names, values;
    for (const auto &[name, value] : properties.items()) {
      names.push_back(name);
      values.push_back(text_of(value));
    }
    if (names != last_names) times = TimeColumns(last_names = names);
    Record record = record_of(values, places_in(names));
    record.time = times.texts(values);
    double milliseconds = 0.0;
    if (text::parse(times.first_text(values), milliseconds))
      record.at = milliseconds / 86400e3;
    else
      record.at = times.time_of(values, record.problem);
    if (coordinates.is_array() && coordinates.size() >= 2) {
      record[Field::longitude] = text_of(coordinates[0]);
      record[Field::latitude] = text_of(coordinates[1]);
      if (coordinates.size() > 2) record[Field::depth] = text_of(coordinates[2]);
    }
    out.add(record, number);
  }
}

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
    record.time = value(origin, "time");
    record.at = parse_date(record.time, record.problem);
    record[Field::latitude] = value(origin, "latitude");
    record[Field::longitude] = value(origin, "longitude");
    record[Field::magnitude] = value(size, "mag");
    record[Field::type] = text::trim(event.child_value("type"));
    record[Field::depth] = value(origin, "depth");
    record.depth_per_km = 1000.0;
    if (!found) out.add_unpreferred();
    out.add(record, lines.of(event.offset_debug()));
  }
}

}  // namespace LSM::postproc
