// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numbers.h
/// Numbers and smallest sizes as text for people.
#ifndef LSM_POSTPROC_NUMBERS_H
#define LSM_POSTPROC_NUMBERS_H

#include <string>
#include <string_view>
#include <vector>

#include "event_table.h"
#include "samples.h"

namespace LSM::postproc {

/// Formats a value with `digits` significant digits, without trailing zeros like %g; "-" for NaN.
std::string short_number(double value, int digits = 4);

/// Formats a value and its standard error with two digits of the error: "1.073 +- 0.024",
/// "(3.1 +- 0.2)e-05". Without an error (NaN or 0), formats only the value.
/// \param plus_minus text between the two numbers
std::string with_error(double value, double error, std::string_view plus_minus = " +- ");

/// Name of a model for people: "fault", "block-slider" or "earthquakes".
/// \param model as in the header of a catalogue
const char *model_name(std::string_view model);

/// Describes a smallest size, as in "0.01, completeness in the header of x.csv".
std::string text(const SmallestSize &smallest);
/// "0.1", or with an offset "0.1 around 0.05 + n 0.1"
std::string text(const MagnitudeBins &bins);
/// Describes the smallest sizes of some catalogues, a line for each different one.
std::vector<std::string> texts(const Threshold &threshold, const std::vector<EventTable> &tables);
/// States the bins of the magnitudes of earthquakes, a line for each of the tables that have them.
std::vector<std::string> bin_notes(const std::vector<EventTable> &tables);

}  // namespace LSM::postproc

#endif
