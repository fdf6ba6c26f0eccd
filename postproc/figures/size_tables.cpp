// SPDX-License-Identifier: GPL-2.0-or-later
// Fitted exponents as a table.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "numbers.h"
#include "size_figures.h"

namespace LSM::postproc {

namespace {

/// "0.001 to 1"
std::string range_text(const PowerLawFit &fit) {
  return fmt::format("{} to {}", short_number(fit.lo, 3),
                     std::isinf(fit.hi) ? "infinity" : short_number(fit.hi, 3));
}

/// "exponent_1e-4:0.1"
std::string name_of(const PowerLawFit &fit) {
  return fmt::format("exponent_{}:{}", short_number(fit.lo, 6), short_number(fit.hi, 6));
}

/// The law that a comparison favours. It is decided by p below 0.05 †.
const char *favoured(const Comparison &comparison) {
  if (comparison.degenerate || comparison.rival.empty()) return "";
  if (!(comparison.p < 0.05)) return "undecided";
  return comparison.log_likelihood_ratio > 0.0 ? "power law favoured" : "rival favoured";
}

/// "mu = -3.2, sigma = 1.5"
std::string parameters_text(const Comparison &comparison) {
  std::string out;
  for (const auto &[name, value] : comparison.parameters)
    out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", name, short_number(value, 6));
  return out;
}

}  // namespace

Table size_fit_table(const std::vector<SizeFit> &fits) {
  struct Line {
    const SizeFit &of;
    const Comparison &rival;
    const PowerLawFit &fit = of.fit;
    double known(double number) const { return rival.degenerate ? NAN : number; }
  };
  TableOf<Line> table;
  table.show("catalogue", [](auto &line) { return line.of.label; });
  table.show("sizes", [](auto &line) { return range_text(line.fit); });
  table.data("model", [](auto &line) { return line.of.model; });
  table.data("lo", [](auto &line) { return line.fit.lo; });
  table.data("hi", [](auto &line) { return line.fit.hi; });
  table.column("n", "events", [](auto &line) { return line.fit.n; });
  table.show("exponent", [](auto &l) { return Measured{l.fit.alpha, l.fit.standard_error}; });
  table.data("exponent", [](auto &line) { return line.fit.alpha; });
  table.data("standard_error", [](auto &line) { return line.fit.standard_error; });
  table.column(
      "ks", "KS distance", [](auto &line) { return line.fit.ks; }, 3);
  table.column("p", "p", [](auto &line) { return line.of.p; });
  table.column("rival", "against", [](auto &line) { return line.rival.rival; });
  table.show("", [](auto &line) { return favoured(line.rival); });
  table.data("parameters", [](auto &line) { return parameters_text(line.rival); });
  table.column(
      "ln_likelihood_ratio", "ln L ratio",
      [](auto &line) { return line.known(line.rival.log_likelihood_ratio); }, 3);
  table.data("normalised", [](auto &line) { return line.known(line.rival.normalised); });
  table.column(
      "rival_p", "p of the comparison", [](auto &line) { return line.known(line.rival.p); }, 2);
  table.data("log_likelihood", [](auto &line) { return line.fit.log_likelihood; });
  table.data("label", [](auto &line) { return line.of.label; });
  table.column("degenerate", "degenerate", [](auto &line) { return line.rival.why; });
  table.data("name", [](auto &line) { return name_of(line.fit); });
  table.comment(
      "density C s^-exponent on [lo, hi] by maximum likelihood, sizes in model energy units, of "
      "earthquakes 10^(1.5 M)");
  if (std::any_of(fits.begin(), fits.end(),
                  [](const SizeFit &fit) { return !fit.comparisons.empty(); }))
    table.comment("one line per rival; ln_likelihood_ratio > 0 favours the power law");
  for (const SizeFit &fit : fits) {
    Comparison none;
    none.degenerate = true;
    none.why = fit.fit.why;
    for (const Comparison &c : fit.comparisons.empty() ? std::vector{none} : fit.comparisons)
      table.row({fit, c});
  }
  return Table(std::move(table));
}

std::vector<std::string> completeness_notes(const std::vector<SizeFit> &fits) {
  std::vector<std::string> notes;
  for (const SizeFit &fit : fits)
    if (fit.fit.lo < fit.completeness)
      notes.push_back(fmt::format(
          "{}: sizes {}: below its completeness of {} the catalogue may depend on the time step",
          fit.label, range_text(fit.fit), short_number(fit.completeness)));
  return notes;
}

}  // namespace LSM::postproc
