// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "event_documents.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/text.h"
#include "text_tables.h"

namespace LSM::postproc {

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

std::string_view without_mark(std::string_view content) {
  return content.substr(content.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0);
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
