// SPDX-License-Identifier: GPL-2.0-or-later
/// \file page.h
/// What pages are made of: their words and their frames, which are files compiled into the program.
#ifndef LSM_POSTPROC_PAGE_H
#define LSM_POSTPROC_PAGE_H

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/replaced_file.h"

namespace LSM::postproc {

/// report.html, a file of figures/explore, or one of its library, as it was when the program was
/// built. \throws std::logic_error if there is no such file
std::string_view page_file(std::string_view name);

/// The text, with each {{key}} replaced by value(key).
std::string filled(std::string_view text,
                   const std::function<std::string(std::string_view)> &value);

/// The part of report.html called name, each {{key}} replaced by the value of that key,
/// without the last line break.
/// \throws std::logic_error if there is no such part, or if keys and values do not match
std::string report_part(const std::string &name,
                        const std::vector<std::pair<std::string_view, std::string>> &values = {});

/// Whether a page is one of this command, by its generator.
Known is_page_of(const std::string &command);

/// gnuplot's SVG as an element of a page: no prologue, identifiers that begin with prefix (those of
/// several pictures would clash), background of the page, title as its name for screen readers.
std::string inline_svg(std::string_view svg, const std::string &prefix, const std::string &title);

/// What stands in the place of numbers that the data do not determine.
std::string degenerate_html(const std::string &why);

}  // namespace LSM::postproc

#endif
