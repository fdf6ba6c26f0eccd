// SPDX-License-Identifier: GPL-2.0-or-later
#include "table1.h"

#include <cmath>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table1Row row_of(const IntervalCurve &curve, const IntervalFit &of) {
  const GeneralisedGammaFit &fit = of.fit;
  Table1Row row;
  row.source = curve.label;
  row.from = curve.from();
  row.method = of.method;
  if (!std::isnan(of.held)) row.method += fmt::format(", δ = {} held", short_number(of.held));
  row.threshold = curve.threshold.size;
  row.n = fit.n;
  row.why = fit.degenerate ? fit.why : "";
  if (fit.degenerate) return row;
  row.parameters = {
      {{fit.gamma, fit.se_gamma}, {fit.delta, fit.se_delta}, {fit.B, fit.se_B}, {fit.C, fit.se_C}}};
  if (fit.dof > 0) row.misfit = fit.chi2 / fit.dof;
  row.ks = fit.ks;
  row.p = of.p;
  return row;
}

/// Seismicity (Corral 2004, as quoted in the paper), LSM, Block-Slider: gamma, delta, B, C.
void add_printed(Table &table) {
  const std::array<std::string, 5> columns[] = {
      {"seismicity (Corral 2004)", "0.67", "0.98", "1.58", "0.50"},
      {"LSM", "0.995", "1.00", "15.21", "0.0573"},
      {"Block-Slider", "0.0", "1.00", "100.0", "0.25"}};
  for (const auto &[source, gamma, delta, B, C] : columns)
    table.row("printed", nan, "", gamma, nan, delta, nan, B, nan, C, nan, nan, nan, nan, nan, "",
              source, "", "", "");
}

}  // namespace

std::vector<Table1Row> table1_rows(const std::vector<IntervalCurve> &curves) {
  std::vector<Table1Row> rows;
  for (const IntervalCurve &curve : curves)
    for (const IntervalFit &fit : curve.fits) rows.push_back(row_of(curve, fit));
  return rows;
}

Table table1(const std::vector<Table1Row> &rows, bool rescaled, bool printed) {
  Table table(
      "origin,threshold,n,gamma,gamma_error,delta,delta_error,B,B_error,C,C_error,"
      "chi2_per_dof,ks,p,p_error,rejected,source,method,degenerate,!from");
  table.show({{"Table 1", "origin"},
              {"", "source"},
              {"", "from"},
              {"", "method"},
              {"times", "n"},
              {"γ", "gamma"},
              {"δ", "delta"},
              {"B", "B"},
              {"C", "C"},
              {"χ²/dof", "chi2_per_dof", 3},
              {"KS", "ks", 3},
              {"p", "p", 2},
              {"rejected", "rejected"},
              {"degenerate", "degenerate"}});
  table.comment("f(theta) = C theta^(gamma-1) exp(-theta^delta / B)");
  table.comment(
      fmt::format("printed: Table 1 of the paper, unit of theta not stated; ours: theta in {}",
                  rescaled ? "multiples of the mean" : "model time, of earthquakes days"));
  table.comment(fmt::format("rejected: {}", rejection_rule));
  if (printed) add_printed(table);
  for (const Table1Row &row : rows) {
    table.add("ours").add(row.threshold).add(row.n);
    for (const Measured &parameter : row.parameters) table.add(parameter);
    table.row(row.misfit, row.ks, row.p,
              std::isnan(row.p.value) ? ""
              : row.rejected()        ? "yes"
                                      : "no",
              row.source, row.method, row.why, row.from);
  }
  return table;
}

}  // namespace LSM::postproc
