// SPDX-License-Identifier: GPL-2.0-or-later
/// \file report_template.h
/// The words and the frame of the report page: report.html, compiled into the program.
#ifndef LSM_POSTPROC_REPORT_TEMPLATE_H
#define LSM_POSTPROC_REPORT_TEMPLATE_H

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace LSM::postproc {

/// report.html as it is; its source is written by CMake.
extern const std::string_view report_template;

/// The part of report.html called name, each {{key}} replaced by the value of that key,
/// without the last line break.
/// \throws std::logic_error if there is no such part, or if keys and values do not match
std::string report_part(std::string_view name,
                        const std::vector<std::pair<std::string_view, std::string>> &values = {});

}  // namespace LSM::postproc

#endif
