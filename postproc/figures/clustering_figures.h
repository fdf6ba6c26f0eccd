// SPDX-License-Identifier: GPL-2.0-or-later
/// \file clustering_figures.h
/// Whether events occur at a steady rate, and which inter-event times follow short and long ones:
/// a table, and figures with a row of panels per curve.
#ifndef LSM_POSTPROC_CLUSTERING_FIGURES_H
#define LSM_POSTPROC_CLUSTERING_FIGURES_H

#include <functional>
#include <string>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Whether the statistics of these figures exist for a curve, which needs at least 20 events.
bool has_clustering(const IntervalCurve &curve);

/// Departure from a steady rate, burstiness, memory and conditional mean times, a row per curve.
/// \param date formats a time of earthquakes, given in days since 1970
Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date);

/// Cumulative number of events against time, with the straight line of a steady rate; periods that
/// are proposed as steady are shaded. Only the first eight curves with has_clustering() are drawn.
/// \throws DegenerateData if there is no such curve
Figure rate_figure(const std::vector<IntervalCurve> &curves);

/// Densities of the inter-event times (over their mean) that follow the shortest, middle and
/// longest third of them, and the mean time after each eighth beside that of times in random order.
/// Draws the same curves as rate_figure().
/// \throws DegenerateData if there is no such curve
Figure conditional_figure(const std::vector<IntervalCurve> &curves);

}  // namespace LSM::postproc

#endif
