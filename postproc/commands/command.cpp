// SPDX-License-Identifier: GPL-2.0-or-later
#include "command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "new_file.h"

namespace LSM::postproc {

namespace {

/// Prints and writes the findings. Returns them for programs.
nlohmann::ordered_json write(const Findings &found, const PictureOptions &picture) {
  nlohmann::ordered_json json;
  for (const Finding &one : found.all()) {
    PictureOptions files = picture;
    files.output += one.ending.value_or("");
    nlohmann::ordered_json value;
    if (const auto *text = std::get_if<std::string>(&one.what)) {
      fmt::print("{}", *text);
    } else if (const auto *warning = std::get_if<Warning>(&one.what)) {
      fmt::print(stderr, "postproc: {}\n", warning->text);
    } else if (const auto *table = std::get_if<Table>(&one.what)) {
      fmt::print("{}", table->text());
      if (one.ending) {
        table->write(files.table());
        fmt::print("wrote {}\n", files.table());
      }
      value = table->json();
    } else if (const auto *figure = std::get_if<Figure>(&one.what)) {
      make(*figure, files);
      value = figure->table.json();
    } else {
      value = *std::get<std::shared_ptr<const nlohmann::ordered_json>>(one.what);
    }
    if (!one.name.empty()) json[one.name] = std::move(value);
  }
  return json;
}

}  // namespace

void Analysis::run() {
  std::vector<Output> others = outputs();
  others.push_back(json.output());
  if (has_base_)
    picture.check(inputs(), endings(), others);
  else
    check_outputs(others, inputs());
  json.write(write(find(), picture));
}

void Analysis::add_picture(CLI::App *command, const std::string &base) {
  has_base_ = true;
  picture.output = base;
  OptionGroup group(command);
  group.add("-o,--output", picture.output,
            "BASE of the files written: BASE.csv (table), BASE.gp (gnuplot script), BASE.png and "
            "BASE.svg",
            kind("BASE"));
  group.flag("--no-picture", picture.no_picture,
             "Write the table and the script, do not run gnuplot");
}

void Analysis::add_table(OptionGroup group, const std::string &base) {
  has_base_ = true;
  picture.output = base;
  group.add("--output,-o", picture.output, "BASE: the table is written to BASE.csv");
}

void Statistic::add_usual(CLI::App *command, const std::string &base) {
  catalogues.add_to(command);
  json.add_to(command);
  add_picture(command, base);
}

std::vector<std::string> picture_files(const std::vector<std::string> &names) {
  std::vector<std::string> files;
  for (const std::string &name : names)
    for (const char *const kind : {".csv", ".gp", ".png", ".svg"}) files.push_back(name + kind);
  return files;
}

#define LSM_COMMAND(name) std::shared_ptr<Command> make_##name();
#include "command_list.def"
#undef LSM_COMMAND

std::vector<std::pair<std::string, std::shared_ptr<Command>>> all_commands() {
  std::vector<std::pair<std::string, std::shared_ptr<Command>>> all;
#define LSM_COMMAND(name) all.emplace_back(#name, make_##name());
#include "command_list.def"
#undef LSM_COMMAND
  return all;
}

}  // namespace LSM::postproc
