// SPDX-License-Identifier: GPL-2.0-or-later
/// \file clustering_figures.h
/// Whether events come at a steady rate, and what follows short and long times: a table, and
/// pictures with a row for each curve.
#ifndef LSM_POSTPROC_CLUSTERING_FIGURES_H
#define LSM_POSTPROC_CLUSTERING_FIGURES_H

#include <functional>
#include <string>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Whether a curve has what these figures show.
bool has_clustering(const IntervalCurve &curve);

/// \param date text of a time of earthquakes, which is in days since 1970
Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date);

/// Cumulative number of events, with the straight line of a steady rate and the stretches proposed
/// as steady shaded. Curves without clustering are left out; the first eight are drawn.
/// \throws std::runtime_error if none is left
Figure rate_figure(const std::vector<IntervalCurve> &curves);

/// Densities of the times, over their mean, that follow the shortest, middle and longest third of
/// the times, and their mean after each eighth beside times in random order. Likewise.
Figure conditional_figure(const std::vector<IntervalCurve> &curves);

}  // namespace LSM::postproc

#endif
