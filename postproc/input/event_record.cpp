// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_record.h"

#include <algorithm>
#include <functional>
#include <set>

#include "files/text.h"

namespace LSM::postproc {

namespace {

/// The names of each field, in its order, as columns and as properties in GeoJSON: in small
/// letters, without blanks, signs and units. The first one that a file has counts.
constexpr std::array<std::string_view, number_of_fields> known_names = {
    "latitude lat latitud", "longitude lon long lng longitud", "mag magnitude mw magnitud",
    "eventtype evtype etype type", "depth dep depthkm profundidad"};

/// A name as in `known_names`.
std::string plain(std::string_view name) {
  std::string out;
  for (const char c : in_small_letters(name.substr(0, name.find_first_of("(/["))))
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z')) out += c;
  return out;
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
  return words.count(in_small_letters(text)) > 0;
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
  static const std::set<std::string, std::less<>> magnitudes = {
      "mag", "magnitude", "mw", "mww", "mwc",  "mwb", "mwr", "mwp", "ml", "mlv",
      "md",  "mc",        "mh", "mb",  "mblg", "ms",  "mj",  "me",  "xm"};
  for (std::size_t i = 0; i < plain_names.size(); ++i)
    if (magnitudes.count(plain_names[i]) > 0 &&
        std::find(places.begin(), places.end(), static_cast<std::ptrdiff_t>(i)) == places.end())
      places.other_magnitudes.push_back(i);
  return places;
}

Record record_of(const Fields &values, const Places &places) {
  Record record;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= 0) record.texts[i] = text::trim(values[static_cast<std::size_t>(places[i])]);
  double other = 0.0;
  for (const std::size_t i : places.other_magnitudes)
    if (text::parse(text::trim(values[i]), other))
      record.other_magnitude = std::max(record.other_magnitude, other);
  return record;
}

}  // namespace LSM::postproc
