// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_checkpoint.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <tuple>

#include <nlohmann/json.hpp>

#include "files/output_file.h"

// nlohmann-json looks up these functions in the namespace of each type.
namespace Slider {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Rupture, step_start, step_end, first, begin, length, size, slip,
                                   slip_cos, slip_sin, pe_start, pe_end)
}

namespace LSM {

using nlohmann::json;

void to_json(json &j, const RecentSlip &slip) { j = {slip.place, slip.step, slip.set}; }
void from_json(const json &j, RecentSlip &slip) {
  std::tie(slip.place, slip.step, slip.set) =
      j.get<std::tuple<std::int64_t, std::int64_t, std::int64_t>>();
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Slider::RuptureState, open, recent)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PickerState, samples, step, time, pe, rate, in_event, step_start,
                                   t_start, pe_start)

}  // namespace LSM

namespace Slider {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChainState, step, slip_sum, slip_compensation, pe_sum,
                                   pe_compensation, quiet_since, pe_anchor, loading_anchor, moved,
                                   dpe, radiated, radiated_compensation, u, v, rest, ahead)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunState, chain, picker, events, dropped_nonpositive,
                                   dropped_small, before_warmup, last_size, by_plate, slip_start,
                                   largest, u_start, ruptures, calm_since)

namespace {

using nlohmann::json;

constexpr int version = 5;
constexpr const char *version_key = "slider_cli checkpoint";

std::uint32_t checksum(const std::vector<std::uint8_t> &bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

void compare(const std::string &path, const std::vector<std::string> &found,
             const std::vector<std::string> &expected) {
  for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i) {
    const std::string x = i < found.size() ? found[i] : "",
                      y = i < expected.size() ? expected[i] : "";
    if (x != y)
      throw std::runtime_error(path + ": cannot resume: checkpoint has '" + x + "', expected '" +
                               y + "'");
  }
}

}  // namespace

void write_checkpoint(const std::string &path, const std::vector<std::string> &settings,
                      const RunState &state) {
  const std::vector<std::uint8_t> run =
      json::to_cbor(json{{"settings", settings}, {"state", state}});
  const json file = {{version_key, version}, {"crc32", checksum(run)}, {"run", json::binary(run)}};
  std::string bytes;
  json::to_cbor(file, bytes);
  LSM::text_io::write_file(path, bytes, true);
}

RunState read_checkpoint(const std::string &path, const std::vector<std::string> &settings) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error(path + ": cannot be read, expected a checkpoint to resume from");
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::runtime_error damaged(
      path + ": damaged checkpoint, or not one of slider_cli, expected a complete file");
  try {
    const json file = json::from_cbor(bytes);
    const int found_version = file.at(version_key).get<int>();
    if (found_version != version)
      throw std::runtime_error(path + ": checkpoint of version " + std::to_string(found_version) +
                               ", expected version " + std::to_string(version) +
                               ": finish that run with the program that started it, or start anew");
    const std::vector<std::uint8_t> &packed = file.at("run").get_binary();
    if (file.at("crc32").get<std::uint32_t>() != checksum(packed)) throw damaged;
    const json run = json::from_cbor(packed);
    compare(path, run.at("settings").get<std::vector<std::string>>(), settings);
    return run.at("state").get<RunState>();
  } catch (const json::exception &) {
    throw damaged;
  }
}

}  // namespace Slider
