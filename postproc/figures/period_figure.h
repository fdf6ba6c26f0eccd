// SPDX-License-Identifier: GPL-2.0-or-later
/// \file period_figure.h
/// Periodicity of the events: Rayleigh's Z against the period.
#ifndef LSM_POSTPROC_PERIOD_FIGURE_H
#define LSM_POSTPROC_PERIOD_FIGURE_H

#include <string>
#include <vector>

#include "periods.h"
#include "plot.h"

namespace LSM::postproc {

/// Rayleigh's Z against the period for each scan, with the level that chance alone reaches.
/// \param labels one for each scan
/// \param unit of the periods
/// \throws std::runtime_error if no scan has a period
Figure period_figure(const std::vector<PeriodScan> &scans, const std::vector<std::string> &labels,
                     const std::string &unit);

}  // namespace LSM::postproc

#endif
