// SPDX-License-Identifier: GPL-2.0-or-later
/// \file page.h
/// Building blocks of HTML pages: templates and texts from files that are compiled into the
/// program, and pictures.
#ifndef LSM_POSTPROC_PAGE_H
#define LSM_POSTPROC_PAGE_H

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/replaced_file.h"

namespace LSM::postproc {

/// Returns a file that was compiled into the program: report.html, or a file of output/explore or
/// of the library that it uses.
/// \throws std::logic_error if there is no such file
std::string_view page_file(std::string_view name);

/// Returns the text with each {{key}} replaced by value(key).
std::string filled(std::string_view text,
                   const std::function<std::string(std::string_view)> &value);

/// Returns a part of report.html with each {{key}} replaced by its value, without the last line
/// break.
/// \throws std::logic_error if there is no such part, a key has no value or a value no key
std::string report_part(const std::string &name,
                        const std::vector<std::pair<std::string_view, std::string>> &values = {});

/// Recognizes the pages that a command of postproc wrote, by their `generator`.
Known is_page_of(const std::string &command);

/// Turns gnuplot's SVG into an element of a page: without prologue and with a transparent
/// background.
/// \param prefix of all identifiers, as those of several pictures would clash
/// \param title name of the picture for screen readers
/// \throws std::invalid_argument if the text is no SVG picture
std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title);

/// Text in place of numbers that the data do not determine.
/// \param why the reason, plain text
std::string degenerate_html(const std::string &why);

}  // namespace LSM::postproc

#endif
