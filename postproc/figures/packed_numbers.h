// SPDX-License-Identifier: GPL-2.0-or-later
/// \file packed_numbers.h
/// Long columns of numbers as text within a page: bytes, compressed by zlib, in base 64. The page
/// undoes it with what every browser has (explore/data.js).
#ifndef LSM_POSTPROC_PACKED_NUMBERS_H
#define LSM_POSTPROC_PACKED_NUMBERS_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace LSM::postproc {

/// Of doubles, floats or bytes, to the last bit: their first bytes, their second bytes, and so on,
/// which compress better. \throws std::runtime_error if zlib cannot compress
template <class Number>
std::string packed(const std::vector<Number> &values);

/// A series of numbers as one byte for each, with errors that are small beside what is seen at any
/// zoom: a number is predicted by linear extrapolation of the two before it, and the byte says by
/// how much the prediction is off, on a logarithmic scale. What was off in one number is made good
/// in the next (the prediction starts from the decoded numbers), so that errors do not add up: they
/// stay below half of the largest change of slope nearby.
struct SeriesCode {
  static constexpr int steps = 127;
  double first = 0.0, second = 0.0;     ///< as they are
  std::array<double, steps + 1> off{};  ///< what byte k adds, byte -k takes away; off[0] is 0
  std::vector<std::int8_t> bytes;       ///< of the third number on
};
SeriesCode encode(const std::vector<double> &values);

}  // namespace LSM::postproc

#endif
