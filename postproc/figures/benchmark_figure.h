// SPDX-License-Identifier: GPL-2.0-or-later
/// \file benchmark_figure.h
/// Ruptures beside reference curves: tables of the misfits, picture of stations and fronts.
#ifndef LSM_POSTPROC_BENCHMARK_FIGURE_H
#define LSM_POSTPROC_BENCHMARK_FIGURE_H

#include <string>
#include <vector>

#include "plot.h"
#include "station_curves.h"

namespace LSM::postproc {

/// A run beside a reference.
struct Misfits {
  const NamedCurves *run;
  std::string reference;
  std::vector<StationMisfit> stations;  ///< that are compared
  MisfitSummary summary;                ///< over all of them
};

/// A row for each station.
Table misfit_table(const std::vector<Misfits> &all);
/// A row for each run beside each reference.
Table misfit_summary_table(const std::vector<Misfits> &all);

/// Slip, slip rate, and slip less that of the last reference, at up to six places that all
/// references have, and arrival times along the fault. \param rate above which the rupture has
/// arrived
Figure benchmark_figure(const std::vector<NamedCurves> &runs,
                        const std::vector<NamedCurves> &references, double rate, double until);

}  // namespace LSM::postproc

#endif
