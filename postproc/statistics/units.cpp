// SPDX-License-Identifier: GPL-2.0-or-later
#include "units.h"

#include <cmath>

namespace LSM::postproc {

namespace {

MagnitudeScale scale_of(double unit, double origin) {
  MagnitudeScale scale;
  scale.constant = scale.slope * (std::log10(unit) - origin);
  return scale;
}

}  // namespace

MagnitudeScale moment_magnitude(double unit) { return scale_of(unit, 9.1); }
MagnitudeScale energy_magnitude(double unit) { return scale_of(unit, 4.4); }

}  // namespace LSM::postproc
