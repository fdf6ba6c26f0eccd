// SPDX-License-Identifier: GPL-2.0-or-later
/// \file page.h
/// What the report page is made of: its words and its frame, which are those of report.html,
/// compiled into the program, and its pictures.
#ifndef LSM_POSTPROC_PAGE_H
#define LSM_POSTPROC_PAGE_H

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plot.h"

namespace LSM::postproc {

/// report.html as it is; its source is written by CMake.
extern const std::string_view report_template;

/// The part of report.html called name, each {{key}} replaced by the value of that key,
/// without the last line break.
/// \throws std::logic_error if there is no such part, or if keys and values do not match
std::string report_part(std::string_view name,
                        const std::vector<std::pair<std::string_view, std::string>> &values = {});

/// gnuplot's SVG as an element of a page: no prologue, identifiers that begin with prefix (those of
/// several pictures would clash), background of the page, title as its name for screen readers.
std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title);

/// Numbers the pictures of a page.
class PageFigures {
 public:
  /// \param caption HTML
  std::string add(const Figure &figure, const std::string &title, const std::string &caption);

 private:
  int count_ = 0;
};

/// What stands in the place of numbers that the data do not determine.
std::string degenerate_html(const std::string &why);

}  // namespace LSM::postproc

#endif
