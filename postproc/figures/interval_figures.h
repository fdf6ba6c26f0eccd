// SPDX-License-Identifier: GPL-2.0-or-later
/// \file interval_figures.h
/// Inter-event times: their probability densities (paper: Figs. 14, 15), and the generalised gamma
/// parameters of the paper's Table 1 beside ours.
#ifndef LSM_POSTPROC_INTERVAL_FIGURES_H
#define LSM_POSTPROC_INTERVAL_FIGURES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Describes the smallest size of a curve and the reason for it; for earthquakes, the smallest
/// magnitude.
std::string source_of(const IntervalCurve &curve);

/// Probability densities with Poisson errors, and the fitted densities.
/// \param rescaled whether the times are divided by their mean
/// \throws DegenerateData if no curve has a point
Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled);

/// gamma (with delta = 1) against the shortest time used in the fit, the cut; a row per cut and
/// curve. The cut that all commands use is marked: the larger of 2.5 memories of the picker and
/// 0.05 of the mean.
Table cuts_table(const std::vector<IntervalCurve> &curves);

/// Departure from a steady rate, variation, burstiness and memory, a row per curve.
/// \param date formats a time of earthquakes, given in days since 1970
Table clustering_table(const std::vector<IntervalCurve> &curves,
                       const std::function<std::string(double)> &date);

/// One of our rows of Table 1.
struct Table1Row {
  std::string source;                  ///< label of the catalogue
  std::string from;                    ///< the smallest size, in words
  std::string method;                  ///< of the fit
  double threshold = 0.0;              ///< smallest size
  double shortest = NAN;               ///< shortest time used in the fit
  std::int64_t n = 0;                  ///< number of inter-event times fitted
  std::array<Measured, 4> parameters;  ///< gamma, delta, B, C; NaN if degenerate
  double misfit = NAN;                 ///< least squares: chi2 per degree of freedom
  double ks = NAN;                     ///< maximum likelihood: KS distance
  Measured p;                          ///< of the fit; NaN: not computed, or no Monte Carlo
  std::string why;                     ///< reason if degenerate, otherwise empty

  bool rejected() const { return p.value < 0.05; }  ///< see rejection_rule
};

/// Explains p and "rejected" to readers of tables and pages.
constexpr std::string_view rejection_rule =
    "p below 0.05. p is the probability of a fit as poor or poorer if the times are independent "
    "and follow the fitted density: least squares from χ² and its degrees of freedom (dof), "
    "maximum likelihood as the share of synthetic samples, each fitted like the data, whose "
    "Kolmogorov-Smirnov distance KS is as large";

/// Returns a row for each fit of each curve.
std::vector<Table1Row> table1_rows(const std::vector<IntervalCurve> &curves);

/// Table 1: first the rows printed in the paper, with the digits printed there (it states no unit
/// of theta, no errors and no size threshold), then ours.
/// \param rescaled whether our times are divided by their mean
/// \param printed false: only our rows
Table table1(const std::vector<Table1Row> &rows, bool rescaled, bool printed = true);

}  // namespace LSM::postproc

#endif
