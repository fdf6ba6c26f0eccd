// SPDX-License-Identifier: GPL-2.0-or-later
/// \file replaced_file.h
/// Which files a program may replace without being asked: earlier versions of the same output,
/// recognized by their first bytes, whatever their names.
#ifndef LSM_REPLACED_FILE_H
#define LSM_REPLACED_FILE_H

#include <functional>
#include <string>
#include <string_view>

namespace LSM {

/// Whether a file that begins with these bytes is an earlier version of the same output.
using Known = std::function<bool(std::string_view head)>;

Known begins_with(std::string text);

/// Describes for messages what a file holds, judging by its first bytes.
std::string content_of(std::string_view head);

/// Returns why a program must not replace path without being asked to, or "".
/// \throws FileError if the file cannot be read
std::string why_kept(const std::string &path, const Known &known = nullptr);

}  // namespace LSM

#endif
