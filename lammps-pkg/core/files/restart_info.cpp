// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/restart_info.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "files/checksum.h"
#include "files/file_error.h"
#include "files/output_file.h"

namespace LSM {

namespace {

void move(const std::string &from, const std::string &to) {
  files::sync(from);
  if (std::rename(from.c_str(), to.c_str()) != 0)
    throw FileError(to + ": cannot create: " + std::generic_category().message(errno));
  const std::string folder = std::filesystem::path(to).parent_path().string();
  files::sync(folder.empty() ? "." : folder);
}

}  // namespace

void seal_restart(const std::string &written, const std::string &path,
                  const files::Parameters &settings) {
  const FileSum sum = sum_of_file(written);
  std::string text;
  for (const auto &[key, value] : settings) text += key + " = " + value + "\n";
  text += "lines = " + std::to_string(crc32(text)) + "\n" + std::to_string(sum.crc32) + " " +
          std::to_string(sum.size) + " " + std::filesystem::path(path).filename().string() + "\n";
  const std::string info = path + ".info";
  std::error_code code;
  std::filesystem::remove(info, code);
  move(written, path);
  files::write_file(info, text, true);
}

files::Parameters check_restart(const std::string &path) {
  const std::string info = path + ".info";
  const FileSum sum = sum_of_file(path);
  std::ifstream in(info);
  if (!in)
    throw FileError(path + ": its checksum file " + info +
                    " is missing, so it may be incomplete; use an earlier restart file");
  files::Parameters settings;
  std::string line, sums, above, stated;
  while (std::getline(in, line)) {
    std::pair<std::string, std::string> setting;
    if (!files::parse_parameter("#" + line, setting)) {
      sums = line;
    } else if (setting.first == "lines") {
      stated = setting.second;
    } else {
      above += line + "\n";
      settings.push_back(std::move(setting));
    }
  }
  if (!settings.empty() && stated != std::to_string(crc32(above)))
    throw FileError(info + ": is damaged, or of an earlier version: its lines have another " +
                    "checksum; its last line alone is accepted, too");
  std::istringstream words(sums);
  std::string expected, size;
  if (!(words >> expected >> size))
    throw FileError(info + ": has no last line with checksum and size of " + path);
  if (size != std::to_string(sum.size))
    throw FileError(path + ": is damaged, it has " + std::to_string(sum.size) +
                    " bytes, expected " + size + " as in " + info +
                    "; use an earlier restart file");
  if (expected != std::to_string(sum.crc32))
    throw FileError(path + ": is damaged, its checksum is not that in " + info +
                    "; use an earlier restart file");
  return settings;
}

}  // namespace LSM
