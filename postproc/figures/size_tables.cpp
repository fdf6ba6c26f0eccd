// SPDX-License-Identifier: GPL-2.0-or-later
// Fitted exponents as a table and JSON.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "numbers.h"
#include "size_figures.h"

namespace LSM::postproc {

using nlohmann::json;

namespace {

/// Adds the numbers of a fit to its JSON object, or the reason why there are none.
template <class Fit>
void add_numbers(json &out, const Fit &fit, const json &found) {
  out["degenerate"] = fit.degenerate;
  if (fit.degenerate)
    out["why"] = fit.why;
  else
    out.update(found);
}

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
  table.column(
      "ln_likelihood_ratio", "ln L ratio",
      [](auto &line) { return line.known(line.rival.log_likelihood_ratio); }, 3);
  table.data("normalised", [](auto &line) { return line.known(line.rival.normalised); });
  table.column(
      "rival_p", "p of the comparison", [](auto &line) { return line.known(line.rival.p); }, 2);
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

static void to_json(json &out, const Comparison &c) {
  out = {{"rival", c.rival}};
  add_numbers(
      out, c,
      {{"log_likelihood_ratio", c.log_likelihood_ratio}, {"normalised", c.normalised}, {"p", c.p}});
  for (const auto &[name, value] : c.parameters) out["parameters"][name] = value;
}

void to_json(json &out, const SizeFit &fit) {
  const PowerLawFit &law = fit.fit;
  out = {{"label", fit.label}, {"model", fit.model}, {"name", name_of(law)},
         {"lo", law.lo},       {"hi", law.hi},       {"n", law.n}};
  add_numbers(out, law,
              {{"exponent", law.alpha},
               {"standard_error", law.standard_error},
               {"ks", law.ks},
               {"log_likelihood", law.log_likelihood},
               {"comparisons", fit.comparisons}});
  if (!std::isnan(fit.p.value)) out.update({{"p", fit.p.value}, {"p_error", fit.p.error}});
}

}  // namespace LSM::postproc
