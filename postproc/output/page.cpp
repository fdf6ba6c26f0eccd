// SPDX-License-Identifier: GPL-2.0-or-later
#include "page.h"

#include <map>
#include <set>
#include <stdexcept>

#include "table.h"

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

std::string report_part(const std::string &name,
                        const std::vector<std::pair<std::string_view, std::string>> &values) {
  const std::string_view page = page_file("report.html");
  const std::string head = "<!-- part " + name + " -->\n";
  const std::size_t begin = page.find(head);
  if (begin == std::string_view::npos)
    throw std::logic_error("report.html has no part '" + name + "'");
  std::string_view part = page.substr(begin + head.size());
  part = part.substr(0, part.find("<!-- part "));
  part = part.substr(0, part.find_last_not_of('\n') + 1);
  const std::map<std::string_view, std::string> known(values.begin(), values.end());
  std::set<std::string_view> used;
  std::string out = filled(part, [&](std::string_view key) {
    if (known.count(key) == 0)
      throw std::logic_error("report.html: nothing for {{" + std::string(key) + "}}");
    used.insert(key);
    return known.at(key);
  });
  if (used.size() < known.size())
    throw std::logic_error("report.html, part '" + name + "': a value without a place");
  return out;
}

Known is_page_of(const std::string &command) {
  const std::string generator = "<meta name=\"generator\" content=\"postproc " + command + "\">";
  return [generator](std::string_view head) {
    return head.substr(0, head.find("<title>")).find(generator) != std::string_view::npos;
  };
}

std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title) {
  const std::size_t begin = svg.find("<svg"), end = svg.find("</svg>");
  if (begin == std::string_view::npos || end == std::string_view::npos)
    throw std::invalid_argument("not an SVG picture");
  std::string out(svg.substr(begin, end + 6 - begin));
  const auto replace_all = [&out](std::string_view from, const std::string &to) {
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
  };
  for (const char *const reference : {" id='", " id=\"", "href='#", "href=\"#", "url(#"})
    replace_all(reference, reference + prefix);
  replace_all("<title>Gnuplot</title>", "<title>" + html_escape(title) + "</title>");
  const std::size_t description = out.find("<desc>"), behind = out.find("</desc>");
  if (description != std::string::npos && behind != std::string::npos)
    out.erase(description, behind + 7 - description);
  // The background is the first element with this attribute. Later matches are left alone, as they
  // may be text.
  const std::string background = "fill=\"#ffffff\"";
  const std::size_t at = out.find(background);
  if (at != std::string::npos) out.replace(at, background.size(), "fill=\"none\"");
  out.insert(4, " role=\"img\"");
  return out;
}

std::string degenerate_html(const std::string &why) {
  return "<span class=\"bad\">degenerate: " + html_escape(why) + "</span>";
}

}  // namespace LSM::postproc
