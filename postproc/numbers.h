// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numbers.h
/// Numbers as people read them, and ranges as they type them.
#ifndef LSM_POSTPROC_NUMBERS_H
#define LSM_POSTPROC_NUMBERS_H

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

namespace LSM::postproc {

/// Events smaller than this are left out of the paper's Figs. 12 and 13 (model energy units).
constexpr double paper_threshold = 1e-4;

/// The value with `digits` significant digits, as short as %g makes it; "-" for NaN.
std::string short_number(double value, int digits = 4);

/// Value and standard error with two digits of the error: "1.073 +- 0.024", "(3.1 +- 0.2)e-05".
/// Without an error (NaN or 0) only the value.
/// \param plus_minus text between the two
std::string with_error(double value, double error, std::string_view plus_minus = " +- ");

/// Smallest and largest of the values seen.
struct Extent {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  void add(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  bool empty() const { return !(hi >= lo); }
};

struct Range {
  double lo, hi;
};

/// "LO:HI" with LO < HI; an end left out is -infinity or infinity.
/// \throws std::invalid_argument naming the option
Range parse_range(const std::string &option, std::string_view text);

}  // namespace LSM::postproc

#endif
