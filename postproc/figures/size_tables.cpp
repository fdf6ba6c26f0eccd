// SPDX-License-Identifier: GPL-2.0-or-later
// Fitted exponents and finite-size scaling as tables and JSON.
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

/// "0.001 to 1", with a mark if search_range() found the range.
std::string range_text(const PowerLawFit &fit) {
  return fmt::format("{} to {}{}", short_number(fit.lo, 3),
                     std::isinf(fit.hi) ? "infinity" : short_number(fit.hi, 3),
                     fit.searched ? " (searched)" : "");
}

/// "exponent_1e-4:0.1", or "exponent_searched_..." if search_range() found the range.
std::string name_of(const PowerLawFit &fit) {
  return fmt::format("exponent_{}{}:{}", fit.searched ? "searched_" : "", short_number(fit.lo, 6),
                     short_number(fit.hi, 6));
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
  table.data("searched", [](auto &line) { return line.fit.searched ? "yes" : "no"; });
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
      "density C s^-exponent on [lo, hi] by maximum likelihood, sizes in model energy units");
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
  out = {{"label", fit.label}, {"model", fit.model}, {"name", name_of(law)},    {"lo", law.lo},
         {"hi", law.hi},       {"n", law.n},         {"searched", law.searched}};
  add_numbers(out, law,
              {{"exponent", law.alpha},
               {"standard_error", law.standard_error},
               {"ks", law.ks},
               {"log_likelihood", law.log_likelihood},
               {"comparisons", fit.comparisons}});
  if (!std::isnan(fit.p.value)) out.update({{"p", fit.p.value}, {"p_error", fit.p.error}});
}

Table scaling_table(const std::vector<Scaling> &scalings) {
  struct Line {
    std::int64_t curve;
    const std::string &label, &model;
    const SizePoint &point;
  };
  TableOf<Line> table;
  table.show("catalogue", [](auto &line) { return line.label; });
  table.data("curve", [](auto &line) { return line.curve; });
  table.data("model", [](auto &line) { return line.model; });
  table.column(
      "length", "length L", [](auto &line) { return line.point.length; }, 6);
  table.show("events", [](auto &line) { return line.point.n; });
  table.show("s* (model energy)", [](auto &l) { return Measured{l.point.s_star, l.point.error}; });
  table.data("s_star", [](auto &line) { return line.point.s_star; });
  table.data("error", [](auto &line) { return line.point.error; });
  table.data("events", [](auto &line) { return line.point.n; });
  table.column(
      "error_independent", "error if events were independent",
      [](auto &line) { return line.point.error_independent; }, 2);
  table.show("blocks", [](auto &line) { return line.point.blocks; });
  table.column(
      "block", "their length (model time)", [](auto &line) { return line.point.block; }, 3);
  table.data("blocks", [](auto &line) { return line.point.blocks; });
  table.data("label", [](auto &line) { return line.label; });
  table.show("degenerate", [](auto &line) { return line.point.why; });
  table.comment("characteristic size <s^2>/<s> in model energy units; errors: bootstrap");
  table.comment(
      "block: length of the blocks of the catalogue that are resampled, model time; 0: single "
      "events; error_independent: if the events were independent");
  std::int64_t number = 0;
  for (const Scaling &scaling : scalings) {
    ++number;
    for (std::size_t i = 0; i < scaling.points.size(); ++i)
      table.row({number, scaling.labels[i], scaling.model, scaling.points[i]});
  }
  return Table(std::move(table));
}

static void to_json(json &out, const Saturation &end) {
  out = {{"m", end.m}, {"L_c", end.L_c},      {"L_c_error", end.se_L_c}, {"s_inf", end.s_inf},
         {"D", end.D}, {"D_error", end.se_D}, {"chi2", end.chi2}};
}

void to_json(json &out, const Scaling &scaling) {
  const ScalingFit &fit = scaling.fit;
  const Saturation &end = fit.saturation;
  out = {{"model", scaling.model},
         {"kl", scaling.stiffness},
         {"events", scaling.kind},
         {"threshold", scaling.threshold.size},
         {"threshold_from", text(scaling.threshold)},
         {"points", json::array()},
         {"degenerate", fit.degenerate},
         {"verdict", verdict(scaling)}};
  for (std::size_t i = 0; i < scaling.points.size(); ++i) {
    const SizePoint &point = scaling.points[i];
    json &one = out["points"].emplace_back(
        json{{"label", scaling.labels[i]}, {"length", point.length}, {"n", point.n}});
    add_numbers(one, point,
                {{"s_star", point.s_star},
                 {"error", point.error},
                 {"error_independent", point.error_independent},
                 {"block", point.block},
                 {"blocks", point.blocks}});
  }
  if (fit.degenerate) return;
  out.update({{"A", fit.A},
              {"A_error", fit.se_A},
              {"D", fit.D},
              {"D_error", fit.se_D},
              {"chi2", fit.chi2},
              {"error_scale", error_scale(fit.chi2, fit.points - 2)},
              {"constant", fit.constant},
              {"constant_error", fit.se_constant},
              {"chi2_constant", fit.chi2_constant},
              {"aicc", fit.aicc},
              {"aicc_constant", fit.aicc_constant},
              {"preferred", to_string(fit.preferred)}});
  if (end.degenerate)
    out["saturation_degenerate"] = end.why;
  else
    out.update({{"s_inf", end.s_inf},
                {"s_inf_error", end.se_s_inf},
                {"L_c", end.L_c},
                {"L_c_error", end.se_L_c},
                {"D_saturation", end.D},
                {"D_saturation_error", end.se_D},
                {"chi2_saturation", end.chi2},
                {"aicc_saturation", end.aicc}});
  for (const Saturation &one : fit.bends)
    if (!one.degenerate) out["bends"].push_back(one);
}

}  // namespace LSM::postproc
