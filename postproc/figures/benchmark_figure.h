// SPDX-License-Identifier: GPL-2.0-or-later
/// \file benchmark_figure.h
/// Ruptures beside reference curves: table of the misfits, picture of stations and fronts.
#ifndef LSM_POSTPROC_BENCHMARK_FIGURE_H
#define LSM_POSTPROC_BENCHMARK_FIGURE_H

#include <string>
#include <vector>

#include "plot.h"
#include "station_curves.h"

namespace LSM::postproc {

/// One run, or one reference, at several places.
struct NamedCurves {
  std::string name;
  double spacing = 0.0;  ///< of the places of a run, 0 of a reference
  std::vector<StationCurve> stations;
};
using BenchmarkCurves = std::vector<NamedCurves>;

/// The run at x, linear between its two nearest places. \throws std::invalid_argument beyond its
/// ends
StationCurve at_place(const NamedCurves &run, double x);
bool near_one_of(const std::vector<double> &places, double x);

Table misfit_table();
void add_misfit(Table &table, const NamedCurves &run, const std::string &reference,
                const StationMisfit &misfit);

/// Slip and slip rate at some places, and arrival times along the fault.
/// \param places empty: up to six that all references have
Figure benchmark_figure(const BenchmarkCurves &runs, const BenchmarkCurves &references,
                        const std::vector<double> &places, double rate, double until);

}  // namespace LSM::postproc

#endif
