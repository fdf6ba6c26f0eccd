// SPDX-License-Identifier: GPL-2.0-or-later
/// \file table1.h
/// Table 1 of the paper, generalised gamma parameters of inter-event times, beside ours.
#ifndef LSM_POSTPROC_TABLE1_H
#define LSM_POSTPROC_TABLE1_H

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "intervals.h"
#include "plot.h"

namespace LSM::postproc {

/// A column of the paper's Table 1 as printed, digits included. The paper states no unit of theta,
/// no errors and no size threshold.
struct PrintedColumn {
  std::string source;                     ///< the head of the column
  std::array<std::string, 4> parameters;  ///< gamma, delta, B, C
};

/// Seismicity (Corral 2004, as quoted in the paper), LSM, Block-Slider.
const std::array<PrintedColumn, 3> &printed_table1();

/// One line of the comparison.
struct Table1Row {
  bool printed = false;                   ///< from the paper
  std::string source;                     ///< head of the column, or label of the catalogue
  std::string from;                       ///< ours: smallest size in words
  std::string method;                     ///< how it was fitted; empty if printed
  double threshold = 0.0;                 ///< ours: smallest size
  std::int64_t n = 0;                     ///< ours: inter-event times fitted
  std::array<std::string, 4> parameters;  ///< with errors; empty if degenerate
  std::array<double, 4> values, errors;
  double misfit = std::numeric_limits<double>::quiet_NaN();   ///< least squares: chi2 per degree
  double ks = std::numeric_limits<double>::quiet_NaN();       ///< maximum likelihood: KS distance
  double p = std::numeric_limits<double>::quiet_NaN();        ///< of the fit; NaN: not computed
  double p_error = std::numeric_limits<double>::quiet_NaN();  ///< if p is a Monte Carlo estimate
  std::string why;                                            ///< reason if degenerate

  bool rejected() const { return p < 0.05; }  ///< see rejection_rule
  /// Misfit or ks, p, and whether rejected; "" if there is none.
  std::string goodness(const std::string &plus_minus = " +- ") const;
};

/// What p and "rejected" mean, for readers.
constexpr std::string_view rejection_rule =
    "p below 0.05. p is the probability of a fit as poor or poorer if the times are independent "
    "and follow the fitted density: least squares from χ² and its degrees of freedom (dof), "
    "maximum likelihood as the share of synthetic samples, each fitted like the data, whose "
    "Kolmogorov-Smirnov distance KS is as large";

/// The printed columns, then ours. \param plus_minus between value and error
std::vector<Table1Row> table1(const std::vector<IntervalCurve> &curves,
                              const std::string &plus_minus = " +- ");

/// For the terminal, printed values apart from ours.
std::string table1_text(const std::vector<Table1Row> &rows, bool rescaled);

/// For BASE.table1.csv.
Table table1_csv(const std::vector<Table1Row> &rows, bool rescaled);

/// "model time", or "multiples of the mean"
const char *theta_unit(bool rescaled);

}  // namespace LSM::postproc

#endif
