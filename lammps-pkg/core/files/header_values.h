// SPDX-License-Identifier: GPL-2.0-or-later
/// \file header_values.h
/// Which values the parameters that programs use may have in the headers of our files.
#ifndef LSM_HEADER_VALUES_H
#define LSM_HEADER_VALUES_H

#include <string>

namespace LSM {

/// Returns what is wrong with the value of a parameter, or "". An invalid value is an error: with a
/// default in its place, results would silently be those of another run.
std::string bad_value(const std::string &key, const std::string &value);

}  // namespace LSM

#endif
