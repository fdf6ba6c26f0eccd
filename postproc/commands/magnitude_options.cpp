// SPDX-License-Identifier: GPL-2.0-or-later
#include "magnitude_options.h"

#include <cmath>
#include <map>
#include <stdexcept>

namespace LSM::postproc {

void MagnitudeOptions::add_to(CLI::App *command, const std::string &group) {
  command
      ->add_option(
          "--magnitude-of", of_moment,
          "size: of the size of an event (an energy); moment: of its slip moment, a column "
          "that not every catalogue has")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, bool>{{"size", false}, {"moment", true}}))
      ->default_str("size")
      ->group(group);
  command
      ->add_option("--magnitude-slope", scale.slope,
                   "Magnitudes per decade of that: 2/3 is the usual one for energy and moment, 1 "
                   "makes M the logarithm itself")
      ->default_str("2/3")
      ->group(group);
  command
      ->add_option("--magnitude-constant", scale.constant,
                   "Magnitude of an event of size (or moment) 1")
      ->group(group);
  command
      ->add_option("--magnitude-bin", bin,
                   "Width of the bins to whose centres, its multiples, magnitudes are rounded, "
                   "halves upwards; 0: none")
      ->group(group);
}

void MagnitudeOptions::check() const {
  if (!std::isfinite(scale.constant))
    throw std::invalid_argument("--magnitude-constant: expected a finite number");
  if (!std::isfinite(scale.slope) || !(scale.slope > 0.0))
    throw std::invalid_argument("--magnitude-slope: expected a positive finite number");
  if (!std::isfinite(bin) || !(bin >= 0.0))
    throw std::invalid_argument("--magnitude-bin: expected a finite number of 0 or more");
}

void MagnitudeOptions::require(const std::string &path, const CatalogueInfo &info) const {
  if (of_moment && !info.slip_moment)
    throw std::runtime_error(path +
                             ": has no column slip_moment, expected one for --magnitude-of moment");
}

}  // namespace LSM::postproc
