// SPDX-License-Identifier: GPL-2.0-or-later
/// \file header_values.h
/// Parameters in the headers of our files that programs use: what their values may be. (Ours.)
#ifndef LSM_HEADER_VALUES_H
#define LSM_HEADER_VALUES_H

#include <string>

namespace LSM {

/// What is wrong with the value of a parameter, or "". A value that programs would have to pass
/// over is an error: with a default in its place, results would be of another run.
std::string bad_value(const std::string &key, const std::string &value);

}  // namespace LSM

#endif
