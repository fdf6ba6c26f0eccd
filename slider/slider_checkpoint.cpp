// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_checkpoint.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "files/binary_io.h"
#include "files/checksum.h"
#include "files/header_keys.h"
#include "files/output_file.h"
#include "files/state.h"

namespace Slider {

namespace {

constexpr int version = 8;
constexpr const char *title = "slider_cli checkpoint ";

/// The key if a run that continues may change its value, otherwise "".
std::string_view may_change(std::string_view setting) {
  const std::string_view key = setting.substr(0, setting.find(" = "));
  const LSM::HeaderKey *const known = LSM::header_key(key);
  return known && known->may_change ? key : "";
}

void compare(const std::string &path, const std::vector<std::string> &found,
             const std::vector<std::string> &expected) {
  for (std::size_t i = 0; i < std::max(found.size(), expected.size()); ++i) {
    const std::string x = i < found.size() ? found[i] : "",
                      y = i < expected.size() ? expected[i] : "";
    if (x != y && (may_change(x).empty() || may_change(x) != may_change(y)))
      throw std::runtime_error(path + ": cannot resume: checkpoint has '" + x + "', expected '" +
                               y + "'");
  }
}

}  // namespace

void write_checkpoint(const std::string &path, const std::vector<std::string> &settings,
                      const RunState &state) {
  std::vector<double> numbers;
  LSM::StateWriter to(numbers);
  to(state);
  std::string run;
  for (const std::string &setting : settings) run += "\n" + setting;
  run += "\n\n";
  for (const double number : numbers) LSM::binary_io::append_bytes(run, number);
  const std::string head =
      title + std::to_string(version) + " " + std::to_string(LSM::crc32(run)) + "\n";
  LSM::files::write_file(path, head + run, true);
}

RunState read_checkpoint(const std::string &path, const std::vector<std::string> &settings) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error(path + ": cannot be read, expected a checkpoint to resume from");
  std::string head;
  std::getline(in, head);
  const std::string run((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::istringstream words(head.rfind(title, 0) == 0 ? head.substr(std::string(title).size()) : "");
  int found_version = 0;
  std::uint32_t sum = 0;
  words >> found_version >> sum;
  if (found_version > 0 && found_version != version)
    throw std::runtime_error(path + ": checkpoint of version " + std::to_string(found_version) +
                             ", expected version " + std::to_string(version) +
                             ": finish that run with the program that started it, or start anew");
  const std::size_t end = run.find("\n\n");
  const std::runtime_error damaged(
      path + ": damaged checkpoint, or not one of slider_cli, expected a complete file");
  if (!words || sum != LSM::crc32(run) || end == std::string::npos) throw damaged;

  std::istringstream lines(run.substr(0, end));
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) found.push_back(line);
  compare(path, found, settings);
  std::vector<double> numbers;
  for (std::size_t at = end + 2; at + sizeof(double) <= run.size(); at += sizeof(double))
    numbers.push_back(LSM::binary_io::from_bytes<double>(run.data() + at));
  RunState state;
  LSM::StateReader from(numbers);
  from(state);
  return state;
}

}  // namespace Slider
