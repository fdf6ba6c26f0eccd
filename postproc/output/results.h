// SPDX-License-Identifier: GPL-2.0-or-later
/// \file results.h
/// Results of a statistic, for people and for programs.
#ifndef LSM_POSTPROC_RESULTS_H
#define LSM_POSTPROC_RESULTS_H

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "plot.h"

namespace LSM::postproc {

/// A text for standard error.
struct Warning {
  std::string text;
};

/// A file written under a temporary name. `close` gives it its own name, once it is known that no
/// output is refused.
struct WrittenFile {
  std::string path;
  std::function<void()> close;
};

/// One result. `name` is its name in JSON; results without a name are not in JSON.
struct Result {
  std::string name;
  std::variant<std::string, Warning, Table, Figure, WrittenFile> what;
  std::optional<std::string> ending;  ///< of its files BASE + ending + .csv, ...; none: no files
};

/// Results in the order in which they are printed. JSON has its names in the order in which they
/// were added first.
class Results {
 public:
  void say(std::string text) { all_.push_back({{}, std::move(text), {}}); }
  void say(const std::vector<std::string> &lines) {
    for (const std::string &line : lines) say(line + "\n");
  }
  void warn(std::string text) { all_.push_back({{}, Warning{std::move(text)}, {}}); }
  void file(const std::string &path, std::function<void()> close) {
    all_.push_back({{}, WrittenFile{path, std::move(close)}, {}});
  }
  /// \param ending none: the table is printed and in JSON, but in no file of its own
  void table(const std::string &name, Table table, std::optional<std::string> ending = {}) {
    all_.push_back({name, std::move(table), std::move(ending)});
  }
  void figure(const std::string &name, Figure figure, const std::string &ending = "") {
    all_.push_back({name, std::move(figure), ending});
  }
  const std::vector<Result> &all() const { return all_; }

 private:
  std::vector<Result> all_;
};

}  // namespace LSM::postproc

#endif
