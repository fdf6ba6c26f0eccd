// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numbers.h
/// Numbers and smallest sizes as people read them.
#ifndef LSM_POSTPROC_NUMBERS_H
#define LSM_POSTPROC_NUMBERS_H

#include <string>
#include <string_view>
#include <vector>

#include "event_table.h"
#include "samples.h"

namespace LSM::postproc {

/// The value with `digits` significant digits, as short as %g makes it; "-" for NaN.
std::string short_number(double value, int digits = 4);

/// Value and standard error with two digits of the error: "1.073 +- 0.024", "(3.1 +- 0.2)e-05".
/// Without an error (NaN or 0) only the value.
/// \param plus_minus text between the two
std::string with_error(double value, double error, std::string_view plus_minus = " +- ");

/// "fault", "block-slider" or "earthquakes", from that in a header.
const char *model_name(std::string_view model);

/// "0.01, completeness in the header of x.csv"
std::string text(const SmallestSize &smallest);
/// One line for each model in tables.
std::vector<std::string> texts(const Threshold &threshold, const std::vector<EventTable> &tables);

}  // namespace LSM::postproc

#endif
