// SPDX-License-Identifier: GPL-2.0-or-later
/// \file moment_rate_input.h
/// Reads moment rates of ruptures, as python3 -m lsm.sources writes them: a table of event_id, time
/// (the middle of an interval) and moment_rate, rupture by rupture.
#ifndef LSM_POSTPROC_MOMENT_RATE_INPUT_H
#define LSM_POSTPROC_MOMENT_RATE_INPUT_H

#include <string>

#include "moment_rates.h"

namespace LSM::postproc {

/// \throws FileError if it is no such table
MomentRates read_moment_rates(const std::string &path);

}  // namespace LSM::postproc

#endif
