// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_condition.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "files/file_error.h"
#include "files/text.h"

namespace LSM::postproc {

EventCondition parse_condition(const std::string &text) {
  using Holds = bool (*)(double, double);
  constexpr Holds equal = [](double a, double b) { return a == b; };
  // Of two that fit at the same place, the longer one comes first.
  constexpr std::pair<std::string_view, Holds> words[] = {
      {"<=", [](double a, double b) { return a <= b; }},
      {">=", [](double a, double b) { return a >= b; }},
      {"!=", [](double a, double b) { return a != b; }},
      {"==", equal},
      {"<", [](double a, double b) { return a < b; }},
      {">", [](double a, double b) { return a > b; }},
      {"=", equal}};
  const std::size_t at = text.find_first_of("<>=!");
  for (const auto &[word, holds] : words) {
    if (at == std::string::npos || text.compare(at, word.size(), word) != 0) continue;
    const std::string column(text::trim(std::string_view(text).substr(0, at)));
    EventCondition out{column, holds, 0.0, word[0] == '>'};
    if (!column.empty() &&
        text::parse(text::trim(std::string_view(text).substr(at + word.size())), out.number))
      return out;
    break;
  }
  throw std::invalid_argument(
      fmt::format("--where {}: expected a column, one of < <= > >= = != and a number, such as "
                  "'peak_slip > 0.001'",
                  text::in_quotes(text)));
}

EventConditions::EventConditions(const std::vector<std::string> &texts, const CatalogueInfo &info,
                                 const std::string &path)
    : info_(info) {
  const std::vector<CatalogueColumn> columns = columns_of(info);
  const bool excess = info.has("friction_work") && info.has("friction_total");
  for (const std::string &text : texts) {
    const EventCondition condition = parse_condition(text);
    const auto found = std::find_if(
        columns.begin(), columns.end(),
        [&condition](const CatalogueColumn &column) { return column.name == condition.column; });
    if (found == columns.end() && excess && condition.column == "excess") {
      all_.push_back({condition, std::nullopt});
      continue;
    }
    if (found == columns.end()) {
      std::string names;
      for (const CatalogueColumn &column : columns)
        names += (names.empty() ? "" : ", ") + std::string(column.name);
      if (excess) names += ", excess";
      throw FileError(fmt::format("{}: has no column {}, expected one of {} for --where", path,
                                  condition.column, names));
    }
    all_.push_back({condition, *found});
  }
}

bool EventConditions::needs_friction_between() const {
  return std::any_of(all_.begin(), all_.end(), [](const One &one) { return !one.column; });
}

void EventConditions::add_friction_between(const EventRow &before, const EventRow &after) {
  friction_between_ += info_.number(after, "friction_total") -
                       info_.number(after, "friction_work") -
                       info_.number(before, "friction_total");
  time_between_ += after.t_start - before.t_end;
}

double EventConditions::value(const One &one, const EventRow &event) const {
  if (one.column) return one.column->of(event);
  return (info_.number(event, "friction_work") -
          friction_between_ / time_between_ * (event.t_end - event.t_start)) /
         event.size;
}

bool EventConditions::hold(const EventRow &event) const {
  return std::all_of(all_.begin(), all_.end(), [&event, this](const One &one) {
    return one.condition.holds(value(one, event), one.condition.number);
  });
}

double EventConditions::least_size() const {
  double least = 0.0;
  for (const One &one : all_)
    if (one.condition.column == "size" && one.condition.from_below)
      least = std::max(least, one.condition.number);
  return least;
}

}  // namespace LSM::postproc
