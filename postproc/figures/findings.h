// SPDX-License-Identifier: GPL-2.0-or-later
/// \file findings.h
/// Findings of a statistic, as text and for programs.
#ifndef LSM_POSTPROC_FINDINGS_H
#define LSM_POSTPROC_FINDINGS_H

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "plot.h"

namespace LSM::postproc {

/// One finding. Names are those in JSON; one with an empty name is left out.
struct Finding {
  std::string name;
  std::string ending;    ///< of its files: BASE + ending + .csv, and so on
  bool warning = false;  ///< a text that is no result
  std::variant<std::string, Table, Figure, std::shared_ptr<const nlohmann::ordered_json>> what;
};

/// In the order in which they are printed; JSON has the order in which they were named.
class Findings {
 public:
  void say(std::string text) { all_.push_back({{}, {}, false, std::move(text)}); }
  void say(const std::vector<std::string> &lines) {
    for (const std::string &line : lines) say(line + "\n");
  }
  void warn(std::string text) { all_.push_back({{}, {}, true, std::move(text)}); }
  void table(const std::string &name, Table table, const std::string &ending) {
    all_.push_back({name, ending, false, std::move(table)});
  }
  void figure(const std::string &name, Figure figure, const std::string &ending = "") {
    all_.push_back({name, ending, false, std::move(figure)});
  }
  /// Only for programs.
  void numbers(const std::string &name, const nlohmann::ordered_json &value);
  void numbers(const std::string &name, const Table &table);
  const std::vector<Finding> &all() const { return all_; }

 private:
  std::vector<Finding> all_;
};

}  // namespace LSM::postproc

#endif
