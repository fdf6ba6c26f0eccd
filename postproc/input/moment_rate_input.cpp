// SPDX-License-Identifier: GPL-2.0-or-later
#include "moment_rate_input.h"

#include <string_view>
#include <utility>

#include "files/line_reader.h"
#include "files/text.h"
#include "input_file.h"

namespace LSM::postproc {

MomentRates read_moment_rates(const std::string &path) {
  constexpr std::string_view first_words = "# made by lsm.sources: moment rate";
  constexpr std::string_view names = "event_id,time,moment_rate";
  files::LineReader reader(open_input(path));
  MomentRates out;
  out.path = path;
  std::string_view line;
  if (!reader.next(line) || line.substr(0, first_words.size()) != first_words)
    throw FileError(path + ": no moment rates, expected a file that begins with " +
                    text::in_quotes(first_words));
  bool more = reader.next(line);
  for (; more && !line.empty() && line.front() == '#'; more = reader.next(line)) {
    std::pair<std::string, std::string> parameter;
    if (files::parse_parameter(line, parameter)) out.parameters.push_back(std::move(parameter));
  }
  const std::string problem = files::take(out.parameters, "spacing", out.interval);
  if (!problem.empty()) throw FileError(path + ": " + problem);
  if (!(out.interval > 0.0)) throw FileError(path + ": spacing is not above 0, expected a time");
  if (!more || line != names) reader.fail("expected " + text::in_quotes(names));
  std::vector<std::string_view> cells;
  while (reader.next(line)) {
    double id = 0.0, time = 0.0, rate = 0.0;
    text::split(line, cells);
    if (!reader.complete() || cells.size() != 3 || !text::parse(cells[0], id) ||
        !text::parse(cells[1], time) || !text::parse(cells[2], rate))
      reader.fail(text::in_quotes(line) + ", expected three numbers");
    if (out.ids.empty() || id != out.ids.back()) {
      out.ids.push_back(id);
      out.firsts.push_back(time);
      out.many.push_back(0.0);
    }
    out.many.back() += 1.0;
    out.rates.push_back(static_cast<float>(rate));
  }
  return out;
}

}  // namespace LSM::postproc
