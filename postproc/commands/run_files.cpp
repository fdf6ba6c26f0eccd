// SPDX-License-Identifier: GPL-2.0-or-later
#include "run_files.h"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "catalogue_input.h"
#include "files/header_keys.h"

namespace LSM::postproc {

namespace {

/// Removes an ending from a path if the path has it.
bool take_off(std::string &path, std::string_view ending) {
  if (path.size() <= ending.size() ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0)
    return false;
  path.resize(path.size() - ending.size());
  return true;
}

/// Path of the file with this ending beside a catalogue, or "" if there is none.
std::string file_beside(const std::string &catalogue, const std::string &ending) {
  std::string base = catalogue;
  for (const std::string_view packed : {".gz", ".xz"})
    if (take_off(base, packed)) break;
  for (const std::string_view kind : {".catalogue.csv", ".ruptures.csv", ".csv"})
    if (take_off(base, kind)) break;
  for (const char *const packed : {"", ".gz", ".xz"}) {
    const std::string path = base + ending + packed;
    if (path != catalogue && std::filesystem::exists(path)) return path;
  }
  return {};
}

}  // namespace

void check_same_run(const HeaderOf &one, const HeaderOf &other) {
  for (const auto &[key, value] : one.parameters) {
    const std::string *const there = files::find(other.parameters, key);
    double a = 0.0, b = 0.0;
    const HeaderKey *const known = header_key(key);
    if (!there || *there == value || (known && known->of == HeaderKey::Of::recording) ||
        (text::parse(value, a) && text::parse(*there, b) && a == b))
      continue;
    throw FileError(fmt::format("{}: {} = {}, but {} in {}: expected a file of the same run",
                                other.path, key, *there, value, one.path));
  }
}

HeaderOf header_of(const EventTable &table) { return {table.path, table.info.header()}; }

void RunFiles::add_to(CLI::App *command) {
  OptionGroup(command, "Files of the runs, in the order of their catalogues; none: leave it out")
      .add(option_, given_, what_, kind("FILE"),
           shown(fmt::format("RUN{} beside RUN.catalogue.csv", ending_)), one_each());
}

std::vector<std::string> RunFiles::of(const std::vector<std::string> &catalogues) const {
  expect_each(option_, given_.size(), "catalogue", catalogues.size());
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < catalogues.size(); ++i)
    paths.push_back(given_.empty()        ? file_beside(catalogues[i], ending_)
                    : given_[i] == "none" ? std::string()
                                          : given_[i]);
  return paths;
}

}  // namespace LSM::postproc
