// SPDX-License-Identifier: GPL-2.0-or-later
#include "slider_stiffness.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "files/checksum.h"
#include "files/file_error.h"
#include "files/input_bytes.h"
#include "files/line_reader.h"
#include "files/text.h"

namespace Slider {

namespace {

using LSM::text::in_quotes;

/// Mean of K(q) / mu' over all wavenumbers by Simpson's rule: the stiffness that a block feels when
/// it slips alone.
double mean_stiffness(Coupling coupling, double width) {
  constexpr int pieces = 8192;
  double sum = 0.0;
  for (int k = 0; k <= pieces; ++k)
    sum += (k == 0 || k == pieces ? 1.0
            : k % 2 == 1          ? 4.0
                                  : 2.0) *
           strip_stiffness(coupling, LSM::pi * k / pieces, width);
  return sum / (3.0 * pieces);
}

}  // namespace

double strip_stiffness(Coupling coupling, double q, double width) {
  if (coupling == Coupling::chain) throw std::logic_error("a chain is no strip");
  const double a = q * width;
  if (a < 1e-6) return 1.0 / width;
  const double fall = std::exp(-2.0 * a);
  if (coupling == Coupling::antiplane) return q * (1.0 + fall) / -std::expm1(-2.0 * a);
  // Numerator and denominator are multiplied by 2 exp(-2a), lest they overflow.
  constexpr double nu = poisson, k = 3.0 - 4.0 * nu, c = 5.0 - 12.0 * nu + 8.0 * nu * nu;
  const double above = k * (1.0 + fall * fall) + 2.0 * fall * (2.0 * a * a + c);
  const double below = -k * std::expm1(-4.0 * a) + 4.0 * a * fall;
  return q / (1.0 - nu) * above / below;
}

Strip strip_of_width(Coupling coupling, double kc, double width) {
  // mu' mean = 2 K_c + mu' / W
  return {2.0 * kc / (mean_stiffness(coupling, width) - 1.0 / width), width};
}

Strip strip_of_leaf_spring(Coupling coupling, double kc, double kl) {
  // K_l W mean(W) = 2 K_c + K_l, and W mean(W) rises with W from 1.
  const auto missing = [&](double width) {
    return 2.0 * kc + kl - kl * width * mean_stiffness(coupling, width);
  };
  double low = 1e-3, high = 1.0;
  while (missing(high) > 0.0 && high < 1e9) high *= 2.0;
  if (!(missing(low) > 0.0) || missing(high) > 0.0)
    throw std::invalid_argument(
        "--kl leaves no thickness of the elastic blocks from 0.001 to 1e9 blocks, expected another");
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (missing(middle) > 0.0 ? low : high) = middle;
  }
  return {kl * high, high};
}

std::vector<double> modes_of(Coupling coupling, const Strip &strip, int blocks) {
  std::vector<double> modes;
  for (int n = 0; n <= blocks / 2; ++n)
    modes.push_back(strip.modulus *
                    strip_stiffness(coupling, 2.0 * LSM::pi * n / blocks, strip.width));
  return modes;
}

std::vector<double> read_modes(const std::string &path, int blocks) {
  std::vector<std::array<double, 2>> table;
  LSM::files::LineReader in(path);
  std::vector<std::string_view> fields;
  for (std::string_view line; in.next(line);) {
    line = LSM::text::trim(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    LSM::text::split(line, fields);
    std::array<double, 2> row{};
    bool sound = fields.size() == row.size();
    for (std::size_t k = 0; sound && k < row.size(); ++k)
      sound = LSM::text::parse(LSM::text::trim(fields[k]), row[k]);
    if (!sound || !(row[1] > 0.0) || (table.empty() ? row[0] != 0.0 : !(row[0] > table.back()[0])))
      in.fail(in_quotes(line) +
              ", expected wavenumber,stiffness with wavenumbers that ascend from " +
              "0, stiffnesses > 0");
    table.push_back(row);
  }
  // The file may round pi to a few digits.
  if (table.size() < 2 || table.back()[0] < LSM::pi * (1.0 - 1e-4))
    throw LSM::FileError(path + ": ends at wavenumber " +
                         (table.empty() ? "none" : LSM::text::number(table.back()[0])) +
                         ", expected lines up to pi, the shortest wave of the blocks");
  std::vector<double> modes;
  std::size_t k = 1;
  for (int n = 0; n <= blocks / 2; ++n) {
    const double q = 2.0 * LSM::pi * n / blocks;
    while (k + 1 < table.size() && table[k][0] < q) ++k;
    const auto &[q0, k0] = table[k - 1];
    const auto &[q1, k1] = table[k];
    modes.push_back(k0 + (k1 - k0) * ((q - q0) / (q1 - q0)));
  }
  return modes;
}

std::string named_with_checksum(const std::string &path) {
  char text[16];
  std::snprintf(text, sizeof text, " %08x", LSM::sum_of_file(path).crc32);
  return path + text;
}

}  // namespace Slider
