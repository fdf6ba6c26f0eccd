// SPDX-License-Identifier: GPL-2.0-or-later
/// \file interval_figures.h
/// Inter-event times: their densities (paper: Figs. 14, 15), and Table 1 of the paper, generalised
/// gamma parameters, beside ours.
#ifndef LSM_POSTPROC_INTERVAL_FIGURES_H
#define LSM_POSTPROC_INTERVAL_FIGURES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// Smallest size and where it comes from; of earthquakes the smallest magnitude.
std::string source_of(const IntervalCurve &curve);

/// Densities with Poisson errors and the fitted curves. \param rescaled times are over their mean
/// \throws std::runtime_error if no curve has a point
Figure interval_figure(const std::vector<IntervalCurve> &curves, bool rescaled, int width = 900);

/// gamma against the shortest time used, a row for each cut of each curve.
Table cuts_table(const std::vector<IntervalCurve> &curves);
/// The same over the mean with errors; 2.5 memories of each picker are marked.
/// \throws std::runtime_error if no curve has a number
Figure cuts_figure(const std::vector<IntervalCurve> &curves, int width = 900);

/// One of our lines.
struct Table1Row {
  std::string source;                  ///< label of the catalogue
  std::string from;                    ///< smallest size in words
  std::string method;                  ///< how it was fitted
  double threshold = 0.0;              ///< smallest size
  double shortest = NAN;               ///< time that is fitted
  std::int64_t n = 0;                  ///< inter-event times fitted
  std::array<Measured, 4> parameters;  ///< gamma, delta, B, C; NaN if degenerate
  double misfit = NAN;                 ///< least squares: chi2 per degree
  double ks = NAN;                     ///< maximum likelihood: KS distance
  Measured p;                          ///< of the fit; NaN: not computed, or no Monte Carlo
  std::string why;                     ///< reason if degenerate

  bool rejected() const { return p.value < 0.05; }  ///< see rejection_rule
};

/// What p and "rejected" mean, for readers.
constexpr std::string_view rejection_rule =
    "p below 0.05. p is the probability of a fit as poor or poorer if the times are independent "
    "and follow the fitted density: least squares from χ² and its degrees of freedom (dof), "
    "maximum likelihood as the share of synthetic samples, each fitted like the data, whose "
    "Kolmogorov-Smirnov distance KS is as large";

std::vector<Table1Row> table1_rows(const std::vector<IntervalCurve> &curves);

/// The columns as printed in the paper, digits included, without unit of theta, errors and size
/// threshold, which it does not state; then ours. \param printed false: ours only
Table table1(const std::vector<Table1Row> &rows, bool rescaled, bool printed = true);

}  // namespace LSM::postproc

#endif
