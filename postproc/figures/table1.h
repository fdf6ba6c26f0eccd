// SPDX-License-Identifier: GPL-2.0-or-later
/// \file table1.h
/// Table 1 of the paper, generalised gamma parameters of inter-event times, beside ours.
#ifndef LSM_POSTPROC_TABLE1_H
#define LSM_POSTPROC_TABLE1_H

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "intervals.h"
#include "table.h"

namespace LSM::postproc {

/// One of our lines.
struct Table1Row {
  std::string source;                  ///< label of the catalogue
  std::string from;                    ///< smallest size in words
  std::string method;                  ///< how it was fitted
  double threshold = 0.0;              ///< smallest size
  std::int64_t n = 0;                  ///< inter-event times fitted
  std::array<Measured, 4> parameters;  ///< gamma, delta, B, C; NaN if degenerate
  double misfit = std::numeric_limits<double>::quiet_NaN();  ///< least squares: chi2 per degree
  double ks = std::numeric_limits<double>::quiet_NaN();      ///< maximum likelihood: KS distance
  Measured p;       ///< of the fit; NaN: not computed, or no Monte Carlo
  std::string why;  ///< reason if degenerate

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
