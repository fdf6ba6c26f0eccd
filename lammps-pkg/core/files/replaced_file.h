// SPDX-License-Identifier: GPL-2.0-or-later
/// \file replaced_file.h
/// Which files a program may replace unasked: what it wrote itself as the same output, known by how
/// the file begins, whatever its name. (Ours.)
#ifndef LSM_REPLACED_FILE_H
#define LSM_REPLACED_FILE_H

#include <functional>
#include <string>
#include <string_view>

namespace LSM {

/// Whether a file that begins with these bytes is an earlier one of the same output.
using Known = std::function<bool(std::string_view head)>;

Known begins_with(std::string text);

/// What a file holds, by its first bytes, for messages.
std::string content_of(std::string_view head);

/// Why a program must not replace path without being asked to, or "". \throws FileError if it
/// cannot be read
std::string why_kept(const std::string &path, const Known &known = nullptr);

}  // namespace LSM

#endif
