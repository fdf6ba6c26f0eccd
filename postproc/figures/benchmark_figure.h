// SPDX-License-Identifier: GPL-2.0-or-later
/// \file benchmark_figure.h
/// Simulated ruptures compared with reference curves: tables of the misfits, and a figure of the
/// stations and of the arrival of the rupture front.
#ifndef LSM_POSTPROC_BENCHMARK_FIGURE_H
#define LSM_POSTPROC_BENCHMARK_FIGURE_H

#include <string>
#include <vector>

#include "plot.h"
#include "station_curves.h"

namespace LSM::postproc {

/// A run compared with one reference.
struct Misfits {
  const NamedCurves *run;
  std::string reference;
  std::vector<StationMisfit> stations;  ///< those that are compared
  MisfitSummary summary;                ///< over these stations
};

/// Misfits at single stations, a row per station.
Table misfit_table(const std::vector<Misfits> &all);
/// Misfits over all stations, a row per run and reference.
Table misfit_summary_table(const std::vector<Misfits> &all);

/// Slip, slip rate, and the difference of the slip from that of the last reference, at up to six
/// places that all references have; and the arrival times along the fault.
/// \param references at least one
/// \param rate slip rate above which the rupture has arrived
/// \param until time at which the curves are cut off
Figure benchmark_figure(const std::vector<NamedCurves> &runs,
                        const std::vector<NamedCurves> &references, double rate, double until);

}  // namespace LSM::postproc

#endif
