// SPDX-License-Identifier: GPL-2.0-or-later
#include "page.h"

namespace LSM::postproc {

std::string filled(std::string_view text,
                   const std::function<std::string(std::string_view)> &value) {
  std::string out;
  for (std::size_t open = 0; (open = text.find("{{")) != std::string_view::npos;) {
    const std::size_t close = text.find("}}", open);
    out += text.substr(0, open);
    out += value(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return out += text;
}

Known is_page_of(const std::string &command) {
  const std::string generator = "<meta name=\"generator\" content=\"postproc " + command + "\">";
  return [generator](std::string_view head) {
    return head.substr(0, head.find("<title>")).find(generator) != std::string_view::npos;
  };
}

}  // namespace LSM::postproc
