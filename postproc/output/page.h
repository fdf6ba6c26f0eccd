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

/// Returns a file that was compiled into the program: of output/explore or of the library that it
/// uses.
/// \throws std::logic_error if there is no such file
std::string_view page_file(std::string_view name);

/// Returns the text with each {{key}} replaced by value(key).
std::string filled(std::string_view text,
                   const std::function<std::string(std::string_view)> &value);

/// Recognizes the pages that a command of postproc wrote, by their `generator`.
Known is_page_of(const std::string &command);

}  // namespace LSM::postproc

#endif
