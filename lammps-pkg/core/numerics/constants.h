// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numerics/constants.h
#ifndef LSM_CONSTANTS_H
#define LSM_CONSTANTS_H

namespace LSM {

constexpr double pi = 3.14159265358979323846;

}  // namespace LSM

#endif
