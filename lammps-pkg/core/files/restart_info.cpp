// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/restart_info.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/output_file.h"

namespace LSM {

namespace {

Cksum sum_of(const std::string &path) {
  text_io::FileBytes in(path);
  Cksum sum;
  std::string block(1 << 20, '\0');
  while (const std::size_t got = in.read(block.data(), block.size()))
    sum.add(std::string_view(block).substr(0, got));
  return sum;
}

void move(const std::string &from, const std::string &to) {
  text_io::sync(from);
  if (std::rename(from.c_str(), to.c_str()) != 0)
    throw FileError(to + ": cannot create: " + std::generic_category().message(errno));
  const std::string folder = std::filesystem::path(to).parent_path().string();
  text_io::sync(folder.empty() ? "." : folder);
}

}  // namespace

void Cksum::add(std::string_view bytes) {
  for (const char c : bytes) push(static_cast<unsigned char>(c));
  size_ += bytes.size();
}

std::uint32_t Cksum::value() const {
  Cksum all = *this;
  for (std::uint64_t rest = size_; rest > 0; rest >>= 8)
    all.push(static_cast<unsigned char>(rest & 0xff));
  return ~all.remainder_;
}

void Cksum::push(unsigned char byte) {
  remainder_ = (remainder_ << 8) ^ table()[(remainder_ >> 24) ^ byte];
}

const std::array<std::uint32_t, 256> &Cksum::table() {
  static const std::array<std::uint32_t, 256> all = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      made[n] = n << 24;
      for (int bit = 0; bit < 8; ++bit)
        made[n] = (made[n] << 1) ^ ((made[n] & 0x80000000U) != 0 ? 0x04C11DB7U : 0U);
    }
    return made;
  }();
  return all;
}

void seal_restart(const std::string &written, const std::string &path,
                  const text_io::Parameters &settings) {
  const Cksum sum = sum_of(written);
  std::string text;
  for (const auto &[key, value] : settings) text += key + " = " + value + "\n";
  text += "lines = " + std::to_string(Cksum(text).value()) + "\n" + std::to_string(sum.value()) +
          " " + std::to_string(sum.size()) + " " + std::filesystem::path(path).filename().string() +
          "\n";
  const std::string info = path + ".info";
  std::error_code code;
  std::filesystem::remove(info, code);
  move(written, path);
  text_io::write_file(info, text, true);
}

text_io::Parameters check_restart(const std::string &path) {
  const std::string info = path + ".info";
  const Cksum sum = sum_of(path);
  std::ifstream in(info);
  if (!in)
    throw FileError(path + ": its checksum file " + info +
                    " is missing, so it may be incomplete; use an earlier restart file");
  text_io::Parameters settings;
  std::string line, sums, above, stated;
  while (std::getline(in, line)) {
    std::pair<std::string, std::string> setting;
    if (!text_io::parse_parameter("#" + line, setting)) {
      sums = line;
    } else if (setting.first == "lines") {
      stated = setting.second;
    } else {
      above += line + "\n";
      settings.push_back(std::move(setting));
    }
  }
  if (!settings.empty() && stated != std::to_string(Cksum(above).value()))
    throw FileError(info + ": is damaged, or of an earlier version: the checksum of its " +
                    "lines is missing; its last line alone is accepted, too");
  std::istringstream words(sums);
  std::string expected, size;
  if (!(words >> expected >> size))
    throw FileError(info + ": has no last line with checksum and size of " + path);
  if (size != std::to_string(sum.size()))
    throw FileError(path + ": is damaged, it has " + std::to_string(sum.size()) +
                    " bytes, expected " + size + " as in " + info +
                    "; use an earlier restart file");
  if (expected != std::to_string(sum.value()))
    throw FileError(path + ": is damaged, its checksum is not that in " + info +
                    "; use an earlier restart file");
  return settings;
}

}  // namespace LSM
