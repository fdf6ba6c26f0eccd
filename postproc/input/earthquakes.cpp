// SPDX-License-Identifier: GPL-2.0-or-later
#include "earthquakes.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "event_collector.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/text.h"

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

namespace {

/// Reads all of a file of earthquakes. Its size is limited because a small compressed file may
/// unpack to anything.
/// \throws FileError if the file, or a line of it (except in JSON), is longer than any can
/// be
std::string all_of(files::Bytes &bytes, const std::string &format) {
  constexpr std::size_t longest_line = 1 << 20, largest = std::size_t{1} << 30;
  std::string out;
  std::size_t line = 0;  // where the last line begins
  for (std::size_t got = 1; got > 0;) {
    const std::size_t known = out.size();
    out.resize(known + head_size);
    got = bytes.read(out.data() + known, head_size);
    out.resize(known + got);
    // Searches only the new part, as searching everything each time would take quadratic time.
    const std::size_t end = std::string_view(out).substr(known).find_last_of("\r\n");
    if (end != std::string_view::npos) line = known + end + 1;
    if (format != "geojson" && out.size() - line > longest_line)
      throw FileError(fmt::format("{}: a line of more than {} bytes, expected events on lines",
                                  bytes.path(), longest_line));
    if (out.size() > largest)
      throw FileError(fmt::format("{}: more than {} bytes, expected several smaller files",
                                  bytes.path(), largest));
  }
  return out;
}

}  // namespace

EarthquakeList read_earthquakes(files::Bytes &bytes, const std::string &format, bool lenient) {
  Collector out(bytes.path(), lenient);
  const std::string_view head = without_mark(bytes.peek(head_size));
  if (files::is_utf16(head)) throw FileError(bytes.path() + files::utf16_text);
  if (head.find('\0') != std::string_view::npos)
    throw FileError(bytes.path() + ": has bytes of 0, expected text");
  const std::string all = format == "quakeml" ? std::string() : all_of(bytes, format);
  const std::string_view content = without_mark(all);
  if (format == "csv") read_columns(content, out);
  if (format == "geojson") read_geojson(content, out);
  if (format == "quakeml") read_quakeml(bytes, out);
  if (format == "zmap") read_zmap(content, out);
  if (format == "scedc") read_scedc(content, out);
  return out.finish();
}

}  // namespace LSM::postproc
