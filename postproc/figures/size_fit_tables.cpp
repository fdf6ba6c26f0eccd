// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_fit_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "log_histogram.h"
#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// JSON has neither NaN nor infinity: null stands for them.
nlohmann::json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace

std::string range_text(const PowerLawFit &fit) {
  return fmt::format("{} to {}{}", short_number(fit.lo, 3),
                     std::isinf(fit.hi) ? "infinity" : short_number(fit.hi, 3),
                     fit.searched ? " (searched)" : "");
}

const char *favoured(const Comparison &comparison) {
  if (!(comparison.p < 0.05)) return "undecided";
  return comparison.log_likelihood_ratio > 0.0 ? "power law favoured" : "rival favoured";
}

std::string verdict(const Comparison &comparison) {
  if (comparison.degenerate) return "degenerate: " + comparison.why;
  return fmt::format("{} (ln L ratio {}, p = {})", favoured(comparison),
                     short_number(comparison.log_likelihood_ratio, 3),
                     short_number(comparison.p, 2));
}

std::string size_fits_text(const std::vector<SizeFit> &fits) {
  std::string out;
  for (const SizeFit &fit : fits) {
    const PowerLawFit &law = fit.fit;
    out += fmt::format("{}: sizes {}, {} events\n", fit.label, range_text(law), law.n);
    if (law.lo < fit.completeness)
      out += fmt::format(
          "  note: below its completeness of {} the catalogue may depend on the time step\n",
          short_number(fit.completeness));
    if (law.degenerate) {
      out += "  degenerate: " + law.why + "\n";
      continue;
    }
    out += fmt::format("  exponent {} (truncated maximum likelihood), KS distance {}",
                       with_error(law.alpha, law.standard_error), short_number(law.ks, 3));
    if (!std::isnan(fit.p))
      out += fmt::format(", p = {}{}", with_error(fit.p, fit.p_error),
                         fit.p < 0.1 ? " (below 0.1: not a power law on this range)" : "");
    out += '\n';
    for (const Comparison &comparison : fit.comparisons) {
      out += fmt::format("  against {}: {}", comparison.rival, verdict(comparison));
      std::string separator = "; ";
      for (const auto &[name, value] : comparison.parameters) {
        out += fmt::format("{}{} = {}", separator, name, short_number(value));
        separator = ", ";
      }
      out += '\n';
    }
  }
  return out;
}

Table size_fits_csv(const std::vector<SizeFit> &fits) {
  Table table(
      "model,lo,hi,searched,n,exponent,standard_error,ks,p,p_error,rival,"
      "ln_likelihood_ratio,normalised,rival_p,label,degenerate");
  table.comment("density C s^-exponent on [lo, hi], sizes in model energy units");
  table.comment("one line per rival; ln_likelihood_ratio > 0 favours the power law");
  for (const SizeFit &fit : fits) {
    const PowerLawFit &law = fit.fit;
    const auto row = [&](const std::string &rival, double ratio, double normalised, double p,
                         const std::string &why) {
      table.row(fit.model, law.lo, law.hi, law.searched ? "yes" : "no", law.n, law.alpha,
                law.standard_error, law.ks, fit.p, fit.p_error, rival, ratio, normalised, p,
                fit.label, why);
    };
    if (fit.comparisons.empty()) row("", nan, nan, nan, law.why);
    for (const Comparison &c : fit.comparisons)
      if (c.degenerate)
        row(c.rival, nan, nan, nan, c.why);
      else
        row(c.rival, c.log_likelihood_ratio, c.normalised, c.p, c.why);
  }
  return table;
}

nlohmann::json to_json(const SizeFit &fit) {
  const PowerLawFit &law = fit.fit;
  nlohmann::json json = {{"label", fit.label},           {"model", fit.model},       {"lo", law.lo},
                         {"hi", number_or_null(law.hi)}, {"searched", law.searched}, {"n", law.n},
                         {"degenerate", law.degenerate}};
  if (law.degenerate) {
    json["why"] = law.why;
    return json;
  }
  json.update({{"exponent", law.alpha},
               {"standard_error", law.standard_error},
               {"ks", law.ks},
               {"log_likelihood", law.log_likelihood},
               {"comparisons", nlohmann::json::array()}});
  if (!std::isnan(fit.p)) json.update({{"p", fit.p}, {"p_error", fit.p_error}});
  for (const Comparison &c : fit.comparisons) {
    nlohmann::json rival = {{"rival", c.rival}, {"degenerate", c.degenerate}};
    if (c.degenerate) {
      rival["why"] = c.why;
    } else {
      for (const auto &[name, value] : c.parameters)
        rival["parameters"][name] = number_or_null(value);
      rival.update({{"log_likelihood_ratio", number_or_null(c.log_likelihood_ratio)},
                    {"normalised", number_or_null(c.normalised)},
                    {"p", number_or_null(c.p)}});
    }
    json["comparisons"].push_back(rival);
  }
  return json;
}

PowerLine fitted_line(const SizeFit &fit, const EventTable &table,
                      const SizeDensitySettings &settings) {
  const PowerLawFit &law = fit.fit;
  const std::vector<double> sizes = column(table.events, &Event::size);
  const LogHistogram histogram(sizes, settings.factor);
  std::int64_t drawn = 0;
  for (const LogBin &bin : histogram.bins(settings.threshold.of(table), settings.upto))
    drawn += bin.count;
  PowerLine line;
  line.slope = -law.alpha;
  line.lo = law.lo;
  line.hi = std::isinf(law.hi) ? *std::max_element(sizes.begin(), sizes.end()) : law.hi;
  // Integral of s^-alpha over the range; exp(-infinity) serves a range without an upper end.
  const double power = 1.0 - law.alpha, logs = std::log(law.hi / law.lo);
  const double integral =
      std::pow(law.lo, power) * (power == 0.0 ? logs : std::expm1(power * logs) / power);
  line.amplitude = static_cast<double>(law.n) / static_cast<double>(drawn) / integral;
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

/// What the bends that are not worse than the best by more than 4 in chi2 give.
std::string range_of_bends(const ScalingFit &fit) {
  double best = HUGE_VAL;
  for (const Saturation &end : fit.bends)
    if (!end.degenerate) best = std::min(best, end.chi2);
  double sharpest = 0.0, roundest = HUGE_VAL, shortest = HUGE_VAL, longest = 0.0;
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const Saturation &end : fit.bends) {
    if (end.degenerate || !(end.chi2 <= best + 4.0)) continue;
    roundest = std::min(roundest, end.m);
    sharpest = std::max(sharpest, end.m);
    shortest = std::min(shortest, end.L_c);
    longest = std::max(longest, end.L_c);
    least = std::min(least, end.D);
    most = std::max(most, end.D);
  }
  if (!(sharpest > roundest)) return {};
  return fmt::format(
      "; bends from {} to {} instead of {} fit as well, with L_c = {} to {}, D = {} to {}",
      roundest, sharpest, Saturation::sharpness, short_number(shortest, 3),
      short_number(longest, 3), short_number(least, 2), short_number(most, 2));
}

std::string verdict(const Scaling &scaling) {
  const ScalingFit &fit = scaling.fit;
  if (fit.degenerate) return "degenerate: " + fit.why;
  const std::string numbers = fmt::format(
      "s* ~ L^D with D = {}, at 95 % from {} to {}, chi2 {} on {} degrees of freedom; AICc {} for "
      "this power law, {} for no "
      "dependence on L",
      with_error(fit.D, fit.se_D), short_number(fit.D - 1.96 * fit.se_D, 2),
      short_number(fit.D + 1.96 * fit.se_D, 2), short_number(fit.chi2), fit.points - 2,
      short_number(fit.aicc), short_number(fit.aicc_constant));
  const Saturation &end = fit.saturation;
  const std::string saturation =
      end.degenerate
          ? "degenerate: " + end.why
          : fmt::format(
                "AICc {} with L_c = {}, s_inf = {}, D = {}, chi2 {} on {} degrees of freedom{}",
                short_number(end.aicc), with_error(end.L_c, end.se_L_c),
                with_error(end.s_inf, end.se_s_inf), with_error(end.D, end.se_D),
                short_number(end.chi2), fit.points - 3, range_of_bends(fit));
  const char *statement = "may or may not depend on the length";
  if (fit.preferred == SizeDependence::none)
    statement = "shows no significant dependence on the length";
  else if (fit.preferred == SizeDependence::power_law)
    statement = fit.D > 0.0 ? "grows with the length"
                            : "shrinks with the length, which no finite-size effect explains";
  else if (fit.preferred == SizeDependence::saturates)
    statement = "grows with the length up to L_c only";
  const char *doubt = "";
  if (fit.preferred == SizeDependence::power_law &&
      gsl_cdf_chisq_Q(fit.chi2, fit.points - 2) < 0.01)
    doubt = ", but not as a power law";
  else if (fit.preferred == SizeDependence::saturates &&
           gsl_cdf_chisq_Q(end.chi2, fit.points - 3) < 0.01)
    doubt = ", but not along the curve fitted";
  return fmt::format(
      "Over {} catalogues the characteristic size of the roll-off {}{} ({}; for growth that "
      "ends, s* = s_inf [1 + (L_c/L)^({}D)]^(-1/{}): {}).",
      fit.points, statement, doubt, numbers, Saturation::sharpness, Saturation::sharpness,
      saturation);
}

std::string scaling_text(const Scaling &scaling) {
  std::string out = fmt::format(
      "finite-size scaling, {}: characteristic size s* = <s^2>/<s>, sizes >= {} (bootstrap "
      "errors, {})\n",
      name_of(scaling), text(scaling.threshold),
      scaling.by_event() ? "single events as if independent" : "blocks of time");
  for (std::size_t i = 0; i < scaling.points.size(); ++i) {
    const SizePoint &point = scaling.points[i];
    out += fmt::format(
        "  {:<32} length {:>6}  n = {:<7} s* = {}{}\n", scaling.labels[i],
        short_number(point.length, 6), point.n,
        point.degenerate ? "degenerate: " + point.why : with_error(point.s_star, point.error),
        point.blocks > 0 ? fmt::format(", {} blocks of {}, error {} of that of independent events",
                                       point.blocks, short_number(point.block, 3),
                                       short_number(point.error / point.error_independent, 2))
                         : "");
  }
  return out + "  " + verdict(scaling) + "\n";
}

nlohmann::json to_json(const Scaling &scaling) {
  nlohmann::json json = {{"model", scaling.model},
                         {"kl", scaling.stiffness},
                         {"events", scaling.kind},
                         {"threshold", scaling.threshold.size},
                         {"threshold_from", text(scaling.threshold)},
                         {"points", nlohmann::json::array()},
                         {"degenerate", scaling.fit.degenerate},
                         {"verdict", verdict(scaling)}};
  for (std::size_t i = 0; i < scaling.points.size(); ++i) {
    const SizePoint &point = scaling.points[i];
    nlohmann::json entry = {{"label", scaling.labels[i]},
                            {"length", point.length},
                            {"n", point.n},
                            {"degenerate", point.degenerate}};
    if (point.degenerate)
      entry["why"] = point.why;
    else
      entry.update({{"s_star", point.s_star},
                    {"error", point.error},
                    {"error_independent", point.error_independent},
                    {"block", point.block},
                    {"blocks", point.blocks}});
    json["points"].push_back(entry);
  }
  const ScalingFit &fit = scaling.fit;
  if (fit.degenerate) return json;
  json.update({{"A", fit.A},
               {"A_error", fit.se_A},
               {"D", fit.D},
               {"D_error", fit.se_D},
               {"chi2", fit.chi2},
               {"constant", fit.constant},
               {"constant_error", fit.se_constant},
               {"chi2_constant", fit.chi2_constant},
               {"aicc", fit.aicc},
               {"aicc_constant", fit.aicc_constant},
               {"preferred", to_string(fit.preferred)}});
  const Saturation &end = fit.saturation;
  if (end.degenerate)
    json["saturation_degenerate"] = end.why;
  else
    json.update({{"s_inf", end.s_inf},
                 {"s_inf_error", end.se_s_inf},
                 {"L_c", end.L_c},
                 {"L_c_error", end.se_L_c},
                 {"D_saturation", end.D},
                 {"D_saturation_error", end.se_D},
                 {"chi2_saturation", end.chi2},
                 {"aicc_saturation", end.aicc}});
  for (const Saturation &one : fit.bends)
    if (!one.degenerate)
      json["bends"].push_back({{"m", one.m},
                               {"L_c", one.L_c},
                               {"L_c_error", one.se_L_c},
                               {"s_inf", one.s_inf},
                               {"D", one.D},
                               {"D_error", one.se_D},
                               {"chi2", one.chi2}});
  return json;
}

Figure scaling_figure(const std::vector<Scaling> &scalings, int width) {
  Figure figure{
      Table("curve,model,length,s_star,error,events,error_independent,block,blocks,label"), {}, {}};
  figure.table.comment("characteristic size <s^2>/<s> in model energy units; errors: bootstrap");
  figure.table.comment(
      "block: length of the blocks of the catalogue that are resampled, model time; 0: single "
      "events; error_independent: if the events were independent");
  std::string plots, lines;
  Extent lengths, heights;
  std::int64_t number = 0;
  for (const Scaling &scaling : scalings) {
    ++number;
    Extent own;
    for (std::size_t i = 0; i < scaling.points.size(); ++i) {
      const SizePoint &point = scaling.points[i];
      figure.table.row(number, scaling.model, point.length, point.s_star, point.error, point.n,
                       point.error_independent, point.block, point.blocks, scaling.labels[i]);
      if (point.degenerate) continue;
      own.add(point.length);
      lengths.add(point.length);
      heights.add(std::max(point.s_star - point.error, 0.1 * point.s_star));
      heights.add(point.s_star + point.error);
    }
    if (own.empty()) continue;
    const std::string column = fmt::format("$1 == {} ? $3 : NaN", number);
    plots +=
        fmt::format("{}{}, \\\n     table using ({}):4 with points lt {} title {}",
                    plots.empty() ? "plot " : ", \\\n     ", error_bars(column, "$4", "$5", number),
                    column, number, quote(name_of(scaling) + ": s*"));
    const ScalingFit &fit = scaling.fit;
    if (fit.degenerate) continue;
    const std::string where = fmt::format("[{}:{}] '+' using 1:", text_io::number(0.85 * own.lo),
                                          text_io::number(own.hi / 0.85));
    lines += fmt::format(
        ", \\\n     {}({}*$1**({})) with lines lt {} title {}", where, text_io::number(fit.A),
        text_io::number(fit.D), number,
        quote_plain(fmt::format("A L^D with D = {}", with_error(fit.D, fit.se_D, " ± "))));
    lines += fmt::format(", \\\n     {}({}) with lines lt 8 dt 2 title 'constant'", where,
                         text_io::number(fit.constant));
    const Saturation &end = fit.saturation;
    if (fit.preferred != SizeDependence::saturates) continue;
    // Sampled evenly in ln L, so that the bend is smooth.
    lines += fmt::format(
        ", \\\n     [1:2] '+' using (x = {}*{}**($1-1)):({}*(1+({}/x)**({}))**({})) with lines lt "
        "{} "
        "dt 4 lw 2 title {}",
        text_io::number(0.85 * own.lo), text_io::number(own.hi / (0.85 * 0.85 * own.lo)),
        text_io::number(end.s_inf), text_io::number(end.L_c),
        text_io::number(end.D * Saturation::sharpness),
        text_io::number(-1.0 / Saturation::sharpness), number,
        quote_plain(fmt::format("growth up to L_c = {}, s_{{∞}} = {}",
                                with_error(end.L_c, end.se_L_c, " ± "),
                                with_error(end.s_inf, end.se_s_inf, " ± "))));
  }
  if (plots.empty())
    throw std::runtime_error("finite-size scaling: no catalogue gives a characteristic size");
  figure.size = size_with_key(std::vector<std::string>(4 * scalings.size()), width);
  bool faults = false, chains = false;
  for (const Scaling &scaling : scalings) (scaling.model == "lsm" ? faults : chains) = true;
  const char *const name = faults && chains ? "length of the fault, or number of blocks"
                           : faults         ? "length of the fault"
                                            : "number of blocks";
  figure.script = axis("x", name, true, 0.9 * lengths.lo, 1.1 * lengths.hi) +
                  axis("y", "characteristic size s* (energy)", true, heights.lo, heights.hi) +
                  std::string(error_bar_function) + plots + lines + "\n";
  return figure;
}

}  // namespace LSM::postproc
