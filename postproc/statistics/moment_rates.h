// SPDX-License-Identifier: GPL-2.0-or-later
/// \file moment_rates.h
/// Moment rates of the ruptures of a run.
#ifndef LSM_POSTPROC_MOMENT_RATES_H
#define LSM_POSTPROC_MOMENT_RATES_H

#include <string>
#include <vector>

#include "files/parameters.h"

namespace LSM::postproc {

struct MomentRates {
  std::string path;
  files::Parameters parameters;  ///< of the header
  double interval = 0.0;         ///< time between two rates
  std::vector<double> ids;       ///< of the ruptures
  std::vector<double> firsts;    ///< time of the first rate of each
  std::vector<double> many;      ///< rates of each
  std::vector<float> rates;      ///< of all, one after the other
};

}  // namespace LSM::postproc

#endif
