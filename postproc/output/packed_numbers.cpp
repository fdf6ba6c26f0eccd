// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <zlib.h>

namespace LSM::postproc {

namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    const std::size_t letters_used = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < 4; ++k)
      out += k < letters_used ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

}  // namespace

template <class Number>
std::string packed(const std::vector<Number> &values) {
  const std::size_t n = values.size(), width = sizeof(Number);
  const auto *const from = reinterpret_cast<const Bytef *>(values.data());
  std::vector<Bytef> bytes(n * width);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < width; ++k) bytes[k * n + i] = from[i * width + k];
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  // Level 3 takes a third of the time of the default level, for 2 % more bytes.
  if (compress2(reinterpret_cast<Bytef *>(out.data()), &size, bytes.data(), bytes.size(), 3) !=
      Z_OK)
    throw std::runtime_error("zlib cannot compress the data of the page");
  out.resize(size);
  return base64(out);
}

template std::string packed(const std::vector<double> &values);
template std::string packed(const std::vector<float> &values);
template std::string packed(const std::vector<std::int8_t> &values);

SeriesCode encode(const std::vector<double> &values) {
  SeriesCode code;
  const std::size_t n = values.size();
  if (n > 0) code.first = values[0];
  if (n > 1) code.second = values[1];
  double most = 0.0, bend = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    most = std::max(most, std::fabs(values[i]));
    if (i > 1) bend = std::max(bend, std::fabs(values[i] - 2.0 * values[i - 1] + values[i - 2]));
  }
  // Deviations below the rounding error of the series itself carry no information.
  const double least = std::max(4.0 * std::numeric_limits<double>::epsilon() * most,
                                std::numeric_limits<double>::min());
  const double top = std::max(2.0 * bend, 2.0 * least);
  const double log_ratio = std::log(top / least) / (SeriesCode::steps - 1);
  for (int k = 1; k <= SeriesCode::steps; ++k)
    code.off[static_cast<std::size_t>(k)] = least * std::exp(log_ratio * (k - 1));
  code.bytes.reserve(n);
  double before = code.first, now = code.second;
  for (std::size_t i = 2; i < n; ++i) {
    const double predicted = 2.0 * now - before, off = values[i] - predicted;
    int k = 0;
    if (std::fabs(off) > 0.5 * least)
      k = std::clamp(
          1 + static_cast<int>(std::lround(std::log(std::fabs(off) / least) / log_ratio)), 1,
          SeriesCode::steps);
    const double step = code.off[static_cast<std::size_t>(k)];
    before = now;
    now = off < 0.0 ? predicted - step : predicted + step;
    code.bytes.push_back(static_cast<std::int8_t>(off < 0.0 ? -k : k));
  }
  return code;
}

}  // namespace LSM::postproc
