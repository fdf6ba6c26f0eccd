// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of gnuplot scripts: quoted text, axes, panels and curves.
#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "plot.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

/// Ticks from the last one not above lo to the first one above hi. They are powers of ten times 1,
/// 2 and 5, or more digits if these give fewer than four ticks.
std::vector<double> ticks_around(double lo, double hi) {
  std::vector<double> ticks;
  for (const auto &digits :
       {std::vector<double>{1, 2, 5}, std::vector<double>{1, 2, 3, 4, 5, 7},
        std::vector<double>{1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9}}) {
    ticks = {0.0};
    for (int n = static_cast<int>(std::floor(std::log10(lo))) - 1; ticks.back() <= hi; ++n)
      for (const double digit : digits) {
        const double tick = digit * std::pow(10.0, n);
        if (tick < lo) ticks.clear();
        if (ticks.empty() || ticks.back() <= hi) ticks.push_back(tick);
      }
    if (ticks.size() >= 4) break;
  }
  return ticks;
}

/// gnuplot executes what is in backquotes or follows a pipe, ends strings at quotes, takes two
/// quotes at the beginning of a string for an empty string, and counts braces. All characters that
/// are not known to be harmless are therefore written as octal numbers.
/// \param markup whether to escape the markup of enhanced mode as well
std::string escape(std::string_view text, bool markup) {
  // Without `markup`, the text may contain markup of our own, which has to stay as it is.
  const std::string_view harmless = markup ? " .,:;()=+-/*%<>!?" : " .,:;()=+-/*%<>!?_^{}";
  std::string out = "\"";
  bool number = false;  // an octal number came last; gnuplot would add a following digit to it
  for (const unsigned char c : valid_utf8(text)) {
    const unsigned char code = c < 0x20 ? ' ' : c;
    if (markup && std::string_view("\\{}^_@&~").find(c) != std::string_view::npos) out += "\\134";
    number = !(code >= 0x80 || std::isalpha(code) || (std::isdigit(code) && !number) ||
               harmless.find(static_cast<char>(code)) != std::string_view::npos);
    out += number ? fmt::format("\\{:03o}", code) : std::string(1, static_cast<char>(code));
  }
  return out + "\"";
}

}  // namespace

std::string quote(std::string_view text) { return escape(text, true); }

std::string quote_plain(std::string_view text) { return escape(text, false); }

std::string axis(std::string_view name, std::string_view label, bool logarithmic, double lo,
                 double hi) {
  std::string out = fmt::format("set {}label {}\n", name, quote_plain(label));
  const bool both = std::isfinite(lo) && std::isfinite(hi);
  if (logarithmic) {
    out += fmt::format("set logscale {}\n", name);
    if (both && hi < 30.0 * lo) {
      // Powers of ten alone would be too few ticks.
      const std::vector<double> ticks = ticks_around(lo, hi);
      lo = ticks.front();
      hi = ticks.back();
      std::string list;
      for (const double tick : ticks)
        list += fmt::format("{}\"{:g}\" {:g}", list.empty() ? "" : ", ", tick, tick);
      out += fmt::format("set {}tics ({})\n", name, list);
    } else {
      // The 1e-9 keeps an end that is on a decade except for rounding from moving to the next one.
      if (std::isfinite(lo)) lo = std::pow(10.0, std::floor(std::log10(lo) + 1e-9));
      if (std::isfinite(hi)) hi = std::pow(10.0, std::ceil(std::log10(hi) - 1e-9));
      // Labels on every decade, or on every second one where they would overlap.
      const bool sparse = both && std::log10(hi / lo) > 12.5;
      out += fmt::format("set format {0} \"10^{{%L}}\"\nset {0}tics {1}\nset m{0}tics {2}\n", name,
                         sparse ? 100 : 10, sparse ? 2 : 10);
    }
  }
  const auto end = [](double value) {
    return std::isfinite(value) ? text::number(value) : std::string("*");
  };
  if (std::isfinite(lo) || std::isfinite(hi))
    out += fmt::format("set {}range [{}:{}]\n", name, end(lo), end(hi));
  return out;
}

Curves::Curves(std::string_view x, std::string_view condition)
    : functions_(fmt::format("row(k) = $1 == k{}{} ? {} : NaN\n", condition.empty() ? "" : " && ",
                             condition, x)) {}

void Curves::add(Layer layer, const std::string &element, const std::string &title) {
  layers_[layer].push_back(element + (title.empty() ? " notitle" : " title " + quote(title)));
  if (!title.empty()) titles_.push_back(title);
}

void Curves::add_data(std::int64_t curve, int y, int error) {
  // Bars are drawn as vectors because gnuplot's yerrorbars surround each point with white in an
  // SVG. A logarithmic axis has no zero: where an error reaches its value, the bar ends one decade
  // below it.
  constexpr std::string_view low = "low(y, e) = y - e > 0.1 * y ? y - e : 0.1 * y\n";
  if (functions_.find(low) == std::string::npos) functions_ += low;
  add(data, fmt::format("table using (row({0})):(low(${1},${2})):(0):(${1}+${2}-low(${1},${2})) "
                        "with vectors heads size screen 0.003,90 lt {0} dt 1 lw 0.8",
                        curve, y, error));
  add(data, fmt::format("table using (row({0})):{1} with points lt {0}", curve, y));
}

void Curves::add_law(double lo, double hi, const std::string &formula, const std::string &style,
                     const std::string &title) {
  add(laws,
      fmt::format("[{}:{}] '+' using 1:({}) with lines {}", text::number(lo), text::number(hi),
                  formula, style),
      title);
}

Figure Curves::figure(Table table, const std::string &axes) const {
  constexpr int width = PictureSize().width;
  std::string elements;
  for (const auto &layer : layers_)
    for (const std::string &element : layer)
      elements += (elements.empty() ? "plot " : ", \\\n     ") + element;
  // gnuplot sets the key in two columns where both fit. It assumes about 9.2 units per character,
  // and 60 for a sample and its gaps.
  std::size_t longest = 0;
  for (const std::string &title : titles_) longest = std::max(longest, title.size());
  const std::size_t columns = 2 * (9.2 * static_cast<double>(longest) + 60.0) < width ? 2 : 1;
  const auto rows = static_cast<int>((titles_.size() + columns - 1) / columns);
  return {std::move(table),
          axes + functions_ + "set samples 400\n" + elements + "\n",
          {width, static_cast<int>(0.56 * width) + 23 * rows}};
}

}  // namespace LSM::postproc
