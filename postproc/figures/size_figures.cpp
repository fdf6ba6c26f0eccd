// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_figures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/text_io.h"
#include "numbers.h"

namespace LSM::postproc {

using nlohmann::json;

namespace {

/// A line that has ends and lies above all points between them; amplitude 0: there are none.
PowerLine placed(PowerLine line, const std::vector<SizeDensity> &densities, const Extent &sizes) {
  if (std::isnan(line.lo)) line.lo = sizes.lo;
  if (std::isnan(line.hi)) line.hi = sizes.hi;
  if (!std::isnan(line.amplitude)) return line;
  line.amplitude = 0.0;
  for (const SizeDensity &density : densities)
    for (const LogBin &bin : density.bins)
      if (bin.centre >= line.lo && bin.centre <= line.hi)
        line.amplitude =
            std::max(line.amplitude, 2.0 * bin.density * std::pow(bin.centre, -line.slope));
  return line;
}

}  // namespace

Figure size_density_figure(const std::vector<SizeDensity> &densities,
                           const std::vector<PowerLine> &lines, int width) {
  // Labels may contain commas, so they come last: awk -F, finds the numbers without them.
  Table table("curve,model,length,bin_lo,bin_hi,size,count,density,error,label");
  table.comment("units: sizes in model energy, densities in 1 / model energy; errors: Poisson");
  Curves curves("$6", "$7 > 0");
  std::vector<std::int64_t> numbers;  // of each catalogue's curve
  std::int64_t number = 0;
  Extent sizes, heights;
  for (const SizeDensity &density : densities) {
    numbers.push_back(density.bins.empty() ? 0 : ++number);
    if (density.bins.empty()) continue;
    for (const LogBin &bin : density.bins) {
      table.row(number, density.model, density.length, bin, density.label);
      if (bin.count == 0) continue;
      sizes.add(bin.lo);
      sizes.add(bin.hi);
      heights.add(bin.density);
    }
    curves.add_data(number, 8, 9);
    // Together, `with linespoints` would surround each point with white in an SVG.
    curves.add(Curves::data,
               fmt::format("table using (row({0})):8 with lines lt {0} lw 1.2", number));
    curves.add(Curves::data, fmt::format("keyentry with linespoints lt {}", number),
               fmt::format("{} ({} events)", density.label, density.events));
  }
  double top = heights.hi;
  for (const PowerLine &given : lines) {
    const PowerLine line = placed(given, densities, sizes);
    if (line.amplitude == 0.0) continue;
    for (const double end : {line.lo, line.hi})
      top = std::max(top, line.amplitude * std::pow(end, line.slope));
    // Colours go by the curves that are drawn.
    const std::int64_t curve = line.catalogue < numbers.size() ? numbers[line.catalogue] : 0;
    curves.add_law(
        line.lo, line.hi,
        fmt::format("{}*$1**({})", text_io::number(line.amplitude), text_io::number(line.slope)),
        fmt::format("lt {} dt {} lw 2.2", curve > 0 ? curve : 8, line.dash), line.title);
  }
  return curves.figure(
      std::move(table),
      axis("x", "event size s (energy, model units)", true, sizes.lo, sizes.hi) +
          axis("y", "probability density p(s) (1 / energy)", true, 0.3 * heights.lo, top),
      width);
}

namespace {

/// Adds the numbers of a fit to what is known of it, or why there are none.
template <class Fit>
void add_numbers(json &out, const Fit &fit, const json &numbers) {
  out["degenerate"] = fit.degenerate;
  if (fit.degenerate)
    out["why"] = fit.why;
  else
    out.update(numbers);
}

/// "0.001 to 1", with what search_range() found marked.
std::string range_text(const PowerLawFit &fit) {
  return fmt::format("{} to {}{}", short_number(fit.lo, 3),
                     std::isinf(fit.hi) ? "infinity" : short_number(fit.hi, 3),
                     fit.searched ? " (searched)" : "");
}

/// "exponent_1e-4:0.1", of a searched range "exponent_searched_...".
std::string name_of(const PowerLawFit &fit) {
  return fmt::format("exponent_{}{}:{}", fit.searched ? "searched_" : "", short_number(fit.lo, 6),
                     short_number(fit.hi, 6));
}

/// Which law a comparison favours; p below 0.05 decides †.
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
  return std::move(table);
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

PowerLine fitted_line(const SizeFit &fit, const SizeDensity &density) {
  const PowerLawFit &law = fit.fit;
  PowerLine line;
  line.slope = -law.alpha;
  line.lo = law.lo;
  line.hi = std::isinf(law.hi) ? density.largest : law.hi;
  line.amplitude = amplitude_of(law, density);
  line.catalogue = fit.catalogue;
  line.dash = 1;
  line.title =
      fmt::format("{}: exponent {}", fit.label, with_error(law.alpha, law.standard_error, " ± "));
  return line;
}

std::string name_of(const Scaling &scaling) {
  std::string name = scaling.model == "lsm" ? "fault" : "block-slider";
  if (!scaling.stiffness.empty()) name += ", Kl = " + scaling.stiffness;
  return scaling.kind == "pe" ? name : name + ", " + scaling.kind;
}

namespace {

std::string text_of(const BendRange &bends) {
  if (!(bends.m.hi > bends.m.lo)) return {};
  return fmt::format(
      "; bends from {} to {} instead of {} fit as well, with L_c = {} to {}, D = {} to {}",
      bends.m.lo, bends.m.hi, Saturation::sharpness, short_number(bends.L_c.lo, 3),
      short_number(bends.L_c.hi, 3), short_number(bends.D.lo, 2), short_number(bends.D.hi, 2));
}

/// What error_scale() did.
std::string scaled_text(double chi2, int freedom) {
  const double scale = error_scale(chi2, freedom);
  return scale > 1.0 ? fmt::format(" (errors times {})", short_number(scale, 2)) : std::string();
}

std::string power_law_text(const ScalingFit &fit) {
  return fmt::format(
      "s* ~ L^D with D = {}, at 95 % from {} to {}, χ² {} on {} degrees of freedom{}; AICc {} for "
      "this power law, {} for no dependence on L",
      with_error(fit.D, fit.se_D), short_number(fit.D - 1.96 * fit.se_D, 2),
      short_number(fit.D + 1.96 * fit.se_D, 2), short_number(fit.chi2), fit.points - 2,
      scaled_text(fit.chi2, fit.points - 2), short_number(fit.aicc),
      short_number(fit.aicc_constant));
}

std::string saturation_text(const ScalingFit &fit) {
  const Saturation &end = fit.saturation;
  if (end.degenerate) return "degenerate: " + end.why;
  return fmt::format("AICc {} with L_c = {}, s_∞ = {}, D = {}, χ² {} on {} degrees of freedom{}{}",
                     short_number(end.aicc), with_error(end.L_c, end.se_L_c),
                     with_error(end.s_inf, end.se_s_inf), with_error(end.D, end.se_D),
                     short_number(end.chi2), fit.points - 3, scaled_text(end.chi2, fit.points - 3),
                     text_of(bends_as_good(fit)));
}

std::string statement(const ScalingFit &fit) {
  switch (fit.preferred) {
    case SizeDependence::none:
      return "shows no significant dependence on the length";
    case SizeDependence::power_law:
      return std::string(fit.D > 0.0
                             ? "grows with the length"
                             : "shrinks with the length, which no finite-size effect explains") +
             (fits_poorly(fit) ? ", but not as a power law" : "");
    case SizeDependence::saturates:
      return std::string("grows with the length up to L_c only") +
             (fits_poorly(fit) ? ", but not along the curve fitted" : "");
    case SizeDependence::undecided:
      break;
  }
  return "may or may not depend on the length";
}

}  // namespace

std::string verdict(const Scaling &scaling) {
  const ScalingFit &fit = scaling.fit;
  if (fit.degenerate) return "degenerate: " + fit.why;
  return fmt::format(
      "Over {0} catalogues the characteristic size of the roll-off {1} ({2}; for growth that ends, "
      "s* = s_∞ [1 + (L_c/L)^({3}D)]^(-1/{3}): {4}).",
      fit.points, statement(fit), power_law_text(fit), Saturation::sharpness, saturation_text(fit));
}

std::string scaling_text(const Scaling &scaling) {
  return fmt::format(
      "finite-size scaling, {}: characteristic size s* = <s^2>/<s>, sizes >= {} (bootstrap errors, "
      "{})\n  {}\n",
      name_of(scaling), text(scaling.threshold),
      scaling.by_event() ? "single events as if independent" : "blocks of time", verdict(scaling));
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
  return std::move(table);
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

namespace {

/// The laws fitted to the points between two lengths.
void add_laws(Curves &curves, const ScalingFit &fit, std::int64_t number, const Extent &lengths) {
  const double lo = 0.85 * lengths.lo, hi = lengths.hi / 0.85;
  const auto exact = [](double value) { return text_io::number(value); };
  curves.add_law(lo, hi, fmt::format("{}*$1**({})", exact(fit.A), exact(fit.D)),
                 fmt::format("lt {}", number),
                 fmt::format("A L^D with D = {}", with_error(fit.D, fit.se_D, " ± ")), quote_plain);
  curves.add_law(lo, hi, exact(fit.constant), "lt 8 dt 2", "constant");
  if (fit.preferred != SizeDependence::saturates) return;
  const Saturation &end = fit.saturation;
  // Sampled evenly in ln L, so that the bend is smooth.
  curves.add(
      Curves::laws,
      fmt::format("[1:2] '+' using (x = {}*{}**($1-1)):({}*(1+({}/x)**({}))**({})) with "
                  "lines lt {} dt 4 lw 2",
                  exact(lo), exact(hi / lo), exact(end.s_inf), exact(end.L_c),
                  exact(end.D * Saturation::sharpness), exact(-1.0 / Saturation::sharpness),
                  number),
      fmt::format("growth up to L_c = {}, s_{{∞}} = {}", with_error(end.L_c, end.se_L_c, " ± "),
                  with_error(end.s_inf, end.se_s_inf, " ± ")),
      quote_plain);
}

}  // namespace

Figure scaling_figure(const std::vector<Scaling> &scalings, int width) {
  Curves curves("$3");
  Extent lengths, heights;
  std::int64_t number = 0;
  bool faults = false, chains = false;
  for (const Scaling &scaling : scalings) {
    ++number;
    (scaling.model == "lsm" ? faults : chains) = true;
    Extent own;
    for (const SizePoint &point : scaling.points) {
      if (point.degenerate) continue;
      own.add(point.length);
      lengths.add(point.length);
      heights.add(std::max(point.s_star - point.error, 0.1 * point.s_star));
      heights.add(point.s_star + point.error);
    }
    if (own.empty()) continue;
    curves.add_data(number, 4, 5, name_of(scaling) + ": s*");
    if (!scaling.fit.degenerate) add_laws(curves, scaling.fit, number, own);
  }
  if (lengths.empty())
    throw std::runtime_error("finite-size scaling: no catalogue gives a characteristic size");
  return curves.figure(
      scaling_table(scalings),
      axis("x",
           faults && chains ? "length of the fault, or number of blocks"
           : faults         ? "length of the fault"
                            : "number of blocks",
           true, 0.9 * lengths.lo, 1.1 * lengths.hi) +
          axis("y", "characteristic size s* (energy)", true, heights.lo, heights.hi),
      width);
}

}  // namespace LSM::postproc
