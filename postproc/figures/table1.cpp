// SPDX-License-Identifier: GPL-2.0-or-later
#include "table1.h"

#include <cmath>

#include <fmt/format.h>

#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

const std::array<PrintedColumn, 3> &printed_table1() {
  static const std::array<PrintedColumn, 3> columns = {{
      {"seismicity (Corral 2004)", {"0.67", "0.98", "1.58", "0.50"}},
      {"LSM", {"0.995", "1.00", "15.21", "0.0573"}},
      {"Block-Slider", {"0.0", "1.00", "100.0", "0.25"}},
  }};
  return columns;
}

std::vector<Table1Row> table1(const std::vector<IntervalCurve> &curves,
                              const std::string &plus_minus) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Table1Row> rows;
  for (const PrintedColumn &column : printed_table1()) {
    Table1Row row;
    row.printed = true;
    row.source = column.source;
    row.parameters = column.parameters;
    for (std::size_t i = 0; i < row.values.size(); ++i)
      text_io::parse(column.parameters[i], row.values[i]);
    row.errors.fill(nan);
    row.threshold = nan;
    rows.push_back(row);
  }
  for (const IntervalCurve &curve : curves) {
    for (const auto &[method, held, fit, p, p_error] : curve.fits) {
      Table1Row row;
      row.source = curve.label;
      row.method = method;
      if (!std::isnan(held)) row.method += fmt::format(", δ = {} held", short_number(held));
      row.threshold = curve.threshold.size;
      row.from = curve.from();
      row.n = fit.n;
      row.values = {fit.gamma, fit.delta, fit.B, fit.C};
      row.errors = {fit.se_gamma, fit.se_delta, fit.se_B, fit.se_C};
      if (fit.degenerate) {
        row.why = fit.why;
        row.values.fill(nan);
        row.errors.fill(nan);
      } else {
        for (std::size_t i = 0; i < row.values.size(); ++i)
          row.parameters[i] = with_error(row.values[i], row.errors[i], plus_minus);
        if (fit.dof > 0) row.misfit = fit.chi2 / fit.dof;
        row.ks = fit.ks;
        row.p = p;
        row.p_error = p_error;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string Table1Row::goodness(const std::string &plus_minus) const {
  std::string out;
  if (!std::isnan(misfit)) out = "χ²/dof " + short_number(misfit, 3);
  if (!std::isnan(ks)) out = "KS " + short_number(ks, 3);
  if (out.empty() || std::isnan(p)) return out;
  // Error and value are the same where no synthetic sample was as far off.
  if (p_error > 0.999 * p)
    out += ", p ≤ " + short_number(p, 2);
  else
    out += ", p = " + (p_error > 0.0 ? with_error(p, p_error, plus_minus) : short_number(p, 2));
  return out + (rejected() ? ", rejected" : "");
}

const char *theta_unit(bool rescaled) {
  return rescaled ? "multiples of the mean" : "model time, of earthquakes days";
}

std::string table1_text(const std::vector<Table1Row> &rows, bool rescaled) {
  const auto line = [](const std::string &name, const std::array<std::string, 4> &cells,
                       const std::string &goodness) {
    // fmt pads by characters as they are shown, so that Greek letters do not shift the columns.
    return fmt::format("    {:<44} {:<17} {:<15} {:<15} {:<20} {}\n", name, cells[0], cells[1],
                       cells[2], cells[3], goodness);
  };
  std::string out = "Table 1: f(θ) = C θ^(γ-1) exp(-θ^δ / B)\n";
  out += line("", {"γ", "δ", "B", "C"}, "goodness of fit");
  out += "  printed in the paper (unit of θ, threshold and errors not stated)\n";
  for (const Table1Row &row : rows)
    if (row.printed) out += line(row.source, row.parameters, "");
  out +=
      fmt::format("  ours (θ in {}, from start to start; standard errors)\n", theta_unit(rescaled));
  std::string head;
  for (const Table1Row &row : rows) {
    if (row.printed) continue;
    std::string next = fmt::format("{}, {}", row.source, row.from);
    if (next != head) {
      head = next;
      out += "    " + head + "\n";
    }
    const std::string method = fmt::format("  {} (n = {})", row.method, row.n);
    if (row.why.empty())
      out += line(method, row.parameters, row.goodness());
    else
      out += fmt::format("    {:<44} degenerate: {}\n", method, row.why);
  }
  return out + fmt::format("  rejected: {}\n", rejection_rule);
}

Table table1_csv(const std::vector<Table1Row> &rows, bool rescaled) {
  Table table(
      "origin,threshold,n,gamma,gamma_error,delta,delta_error,B,B_error,C,C_error,"
      "chi2_per_dof,ks,p,p_error,rejected,source,method,degenerate");
  table.comment("f(theta) = C theta^(gamma-1) exp(-theta^delta / B)");
  table.comment(
      fmt::format("printed: Table 1 of the paper, unit of theta not stated; ours: theta in {}",
                  theta_unit(rescaled)));
  table.comment(fmt::format("rejected: {}", rejection_rule));
  for (const Table1Row &row : rows) {
    table.add(row.printed ? "printed" : "ours").add(row.threshold);
    row.printed ? table.add("") : table.add(row.n);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      // Printed digits are kept: 1.00 is not 1.
      row.printed ? table.add(row.parameters[i]) : table.add(row.values[i]);
      table.add(row.errors[i]);
    }
    table.row(row.misfit, row.ks, row.p, row.p_error,
              std::isnan(row.p) ? ""
              : row.rejected()  ? "yes"
                                : "no",
              row.source, row.method, row.why);
  }
  return table;
}

}  // namespace LSM::postproc
