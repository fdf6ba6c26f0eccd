// SPDX-License-Identifier: GPL-2.0-or-later
#include "command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "new_file.h"

namespace LSM::postproc {

namespace {

PictureOptions files_of(const Result &one, PictureOptions picture) {
  picture.output += one.ending.value_or("");
  return picture;
}

/// Checks the files of all results before the first is written.
/// \throws FileError if one cannot be written, or would replace a file of something else
void check_files(const Results &results, const PictureOptions &picture) {
  for (const Result &one : results.all()) {
    const PictureOptions files = files_of(one, picture);
    const auto *const table = std::get_if<Table>(&one.what);
    if (table && one.ending)
      check_output(files.table(), files.overwrite,
                   [table](std::string_view head) { return table->like(head); });
    if (const auto *figure = std::get_if<Figure>(&one.what)) check_outputs(*figure, files);
  }
}

nlohmann::ordered_json json_of(const Results &results) {
  nlohmann::ordered_json json;
  for (const Result &one : results.all()) {
    if (one.name.empty()) continue;
    if (const auto *table = std::get_if<Table>(&one.what))
      json[one.name] = table->json();
    else
      json[one.name] = std::get<Figure>(one.what).table.json();
  }
  return json;
}

void write(const Results &results, const PictureOptions &picture) {
  for (const Result &one : results.all()) {
    const PictureOptions files = files_of(one, picture);
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
    } else if (const auto *figure = std::get_if<Figure>(&one.what)) {
      make(*figure, files);
    } else if (const auto *file = std::get_if<WrittenFile>(&one.what)) {
      file->close();
      fmt::print("wrote {}\n", file->path);
    }
  }
}

}  // namespace

void Command::add_all_options(CLI::App *command) {
  add_options(command);
  OptionGroup(command).flag(
      "--overwrite", overwrite,
      "Replace what is there. Without it, only figures, tables, pages and JSON of an earlier run of "
      "the same command are replaced");
}

void Analysis::run() {
  const std::vector<Output> others = {{"--output", file_}, json.output()};
  if (has_base_)
    picture.check(inputs(), endings(), others);
  else
    check_outputs(others, inputs());
  picture.overwrite = overwrite;
  json.check(overwrite);
  const Results results = find();
  const nlohmann::ordered_json numbers = json_of(results);
  check_files(results, picture);
  json.check(overwrite, &numbers);
  write(results, picture);
  json.write(numbers);
}

void Analysis::add_picture(CLI::App *command, const std::string &base) {
  has_base_ = true;
  picture.output = base;
  OptionGroup group(command);
  group.add("-o,--output", picture.output,
            "Files written: BASE.csv (table), BASE.gp (gnuplot script), BASE.png and BASE.svg",
            kind("BASE"), shown("COMMAND"));
  group.flag("--no-picture", picture.no_picture,
             "Write the table and the script, do not run gnuplot");
}

void Analysis::add_table(OptionGroup group, const std::string &base) {
  has_base_ = true;
  picture.output = base;
  group.add("--output,-o", picture.output, "The table is written to BASE.csv", kind("BASE"));
}

void Statistic::add_usual(CLI::App *command, const std::string &base) {
  add_catalogues(command, catalogues);
  json.add_to(command);
  add_picture(command, base);
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
