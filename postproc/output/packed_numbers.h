// SPDX-License-Identifier: GPL-2.0-or-later
/// \file packed_numbers.h
/// Long columns of numbers as text within an HTML page: compressed by zlib, then encoded in base
/// 64, which every browser can decode (explore/data.js).
#ifndef LSM_POSTPROC_PACKED_NUMBERS_H
#define LSM_POSTPROC_PACKED_NUMBERS_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace LSM::postproc {

/// Packs doubles, floats or bytes without loss. The first bytes of all numbers are stored together,
/// then their second bytes, and so on, which compresses better.
/// \throws std::runtime_error if zlib cannot compress
template <class Number>
std::string packed(const std::vector<Number> &values);

/// A series encoded as one byte per number, with errors that are invisible at any zoom. Each number
/// is predicted by linear extrapolation of the two before it, and its byte is the deviation from
/// the prediction on a logarithmic scale. Predictions start from the decoded numbers, so that the
/// error of one number is corrected by the next and errors do not accumulate: they stay below half
/// of the largest change of slope nearby.
struct SeriesCode {
  static constexpr int steps = 127;
  double first = 0.0, second = 0.0;     ///< the first two numbers, not encoded
  std::array<double, steps + 1> off{};  ///< byte k adds off[k], byte -k subtracts it; off[0] is 0
  std::vector<std::int8_t> bytes;       ///< from the third number on
};
/// Encodes a series.
SeriesCode encode(const std::vector<double> &values);

}  // namespace LSM::postproc

#endif
