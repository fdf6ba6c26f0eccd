// SPDX-License-Identifier: GPL-2.0-or-later
#include "report_template.h"

#include <algorithm>
#include <stdexcept>

namespace LSM::postproc {

std::string report_part(std::string_view name,
                        const std::vector<std::pair<std::string_view, std::string>> &values) {
  const std::string head = "<!-- part " + std::string(name) + " -->\n";
  const std::size_t begin = report_template.find(head);
  if (begin == std::string_view::npos)
    throw std::logic_error("report.html has no part '" + std::string(name) + "'");
  std::string_view rest = report_template.substr(begin + head.size());
  rest = rest.substr(0, rest.find("<!-- part "));
  std::string out;
  std::vector<bool> used(values.size());
  for (std::size_t open = 0; (open = rest.find("{{")) != std::string_view::npos;) {
    const std::size_t close = rest.find("}}", open);
    const std::string_view key = rest.substr(open + 2, close - open - 2);
    const auto value = std::find_if(values.begin(), values.end(),
                                    [key](const auto &pair) { return pair.first == key; });
    if (value == values.end())
      throw std::logic_error("report.html: nothing for {{" + std::string(key) + "}}");
    used[static_cast<std::size_t>(value - values.begin())] = true;
    out += rest.substr(0, open);
    out += value->second;
    rest.remove_prefix(close + 2);
  }
  if (std::find(used.begin(), used.end(), false) != used.end())
    throw std::logic_error("report.html, part '" + std::string(name) +
                           "': a value without a place");
  out += rest.substr(0, rest.find_last_not_of('\n') + 1);
  return out;
}

}  // namespace LSM::postproc
