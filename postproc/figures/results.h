// SPDX-License-Identifier: GPL-2.0-or-later
/// \file results.h
/// Results of a statistic, as text and for programs.
#ifndef LSM_POSTPROC_RESULTS_H
#define LSM_POSTPROC_RESULTS_H

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "plot.h"

namespace LSM::postproc {

/// A text that is no result.
struct Warning {
  std::string text;
};

/// A file that has been written beside its place, and gets its name once no output is refused.
struct WrittenFile {
  std::string path;
  std::function<void()> close;
};

/// One result. Names are those in JSON; one with an empty name is left out.
struct Result {
  std::string name;
  std::variant<std::string, Warning, Table, Figure, WrittenFile,
               std::shared_ptr<const nlohmann::ordered_json>>
      what;
  std::optional<std::string> ending;  ///< of its files, if it has any: BASE + ending + .csv, ...
};

/// In the order in which they are printed; JSON has the order in which they were named.
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
  void table(const std::string &name, Table table, const std::string &ending) {
    all_.push_back({name, std::move(table), ending});
  }
  void figure(const std::string &name, Figure figure, const std::string &ending = "") {
    all_.push_back({name, std::move(figure), ending});
  }
  /// Printed and in JSON, but in no file of its own.
  void table(const std::string &name, Table table) { all_.push_back({name, std::move(table), {}}); }
  /// Only for programs: JSON of any kind.
  template <class Json>
  void numbers(const std::string &name, const Json &value) {
    all_.push_back({name, std::make_shared<const nlohmann::ordered_json>(value), {}});
  }
  const std::vector<Result> &all() const { return all_; }

 private:
  std::vector<Result> all_;
};

}  // namespace LSM::postproc

#endif
