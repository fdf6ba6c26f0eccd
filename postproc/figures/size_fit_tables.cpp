// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_fit_tables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "log_histogram.h"
#include "lsm_text_io.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

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
  Table table({"model", "lo", "hi", "searched", "n", "exponent", "standard_error", "ks", "p",
               "p_error", "rival", "ln_likelihood_ratio", "normalised", "rival_p", "label",
               "degenerate"});
  table.comment("density C s^-exponent on [lo, hi], sizes in model energy units");
  table.comment("one line per rival; ln_likelihood_ratio > 0 favours the power law");
  for (const SizeFit &fit : fits) {
    const PowerLawFit &law = fit.fit;
    const auto begin = [&] {
      table.add(fit.model).add(law.lo).add(law.hi);
      table.add(law.searched ? "yes" : "no").add(law.n).add(law.alpha).add(law.standard_error);
      table.add(law.ks).add(fit.p).add(fit.p_error);
    };
    if (fit.comparisons.empty()) {
      begin();
      table.add("").add("").add("").add("").add(fit.label).add(law.why).end_row();
    }
    for (const Comparison &comparison : fit.comparisons) {
      begin();
      table.add(comparison.rival);
      if (comparison.degenerate)
        table.add("").add("").add("");
      else
        table.add(comparison.log_likelihood_ratio).add(comparison.normalised).add(comparison.p);
      table.add(fit.label).add(comparison.why).end_row();
    }
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
  json["exponent"] = law.alpha;
  json["standard_error"] = law.standard_error;
  json["ks"] = law.ks;
  json["log_likelihood"] = law.log_likelihood;
  if (!std::isnan(fit.p)) {
    json["p"] = fit.p;
    json["p_error"] = fit.p_error;
  }
  json["comparisons"] = nlohmann::json::array();
  for (const Comparison &comparison : fit.comparisons) {
    nlohmann::json rival = {{"rival", comparison.rival}, {"degenerate", comparison.degenerate}};
    if (comparison.degenerate) {
      rival["why"] = comparison.why;
    } else {
      for (const auto &[name, value] : comparison.parameters)
        rival["parameters"][name] = number_or_null(value);
      rival["log_likelihood_ratio"] = number_or_null(comparison.log_likelihood_ratio);
      rival["normalised"] = number_or_null(comparison.normalised);
      rival["p"] = number_or_null(comparison.p);
    }
    json["comparisons"].push_back(rival);
  }
  return json;
}

PowerLine fitted_line(const SizeFit &fit, const EventTable &table,
                      const SizeDensitySettings &settings) {
  const PowerLawFit &law = fit.fit;
  LogHistogram histogram(settings.factor);
  for (const double size : table.size) histogram.add(size);
  std::int64_t drawn = 0;
  for (const LogBin &bin : histogram.bins(settings.threshold.of(table), settings.upto))
    drawn += bin.count;
  PowerLine line;
  line.slope = -law.alpha;
  line.lo = law.lo;
  line.hi = std::isinf(law.hi) ? *std::max_element(table.size.begin(), table.size.end()) : law.hi;
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
  return scaling.ruptures ? name + ", ruptures" : name;
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
      "; bends from {} to {} in place of {} fit as well, with L_c = {} to {}, D = {} "
      "to {}",
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
  const char *statement = "does not tell whether it depends on the length";
  if (fit.preferred == SizeDependence::none)
    statement = "shows no significant dependence on the length";
  else if (fit.preferred == SizeDependence::power_law)
    statement = fit.D > 0.0 ? "grows with the length"
                            : "shrinks with the length, which no finite-size effect explains";
  else if (fit.preferred == SizeDependence::saturates)
    statement = "grows with the length up to L_c and no further";
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
      scaling.by_event() ? "events one by one as if independent" : "blocks of time");
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
                         {"events", scaling.ruptures ? "ruptures" : "pe"},
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
    if (point.degenerate) {
      entry["why"] = point.why;
    } else {
      entry["s_star"] = point.s_star;
      entry["error"] = point.error;
      entry["error_independent"] = point.error_independent;
      entry["block"] = point.block;
      entry["blocks"] = point.blocks;
    }
    json["points"].push_back(entry);
  }
  const ScalingFit &fit = scaling.fit;
  if (fit.degenerate) return json;
  json["A"] = fit.A;
  json["A_error"] = fit.se_A;
  json["D"] = fit.D;
  json["D_error"] = fit.se_D;
  json["chi2"] = fit.chi2;
  json["constant"] = fit.constant;
  json["constant_error"] = fit.se_constant;
  json["chi2_constant"] = fit.chi2_constant;
  json["aicc"] = fit.aicc;
  json["aicc_constant"] = fit.aicc_constant;
  const Saturation &end = fit.saturation;
  if (end.degenerate) {
    json["saturation_degenerate"] = end.why;
  } else {
    json["s_inf"] = end.s_inf;
    json["s_inf_error"] = end.se_s_inf;
    json["L_c"] = end.L_c;
    json["L_c_error"] = end.se_L_c;
    json["D_saturation"] = end.D;
    json["D_saturation_error"] = end.se_D;
    json["chi2_saturation"] = end.chi2;
    json["aicc_saturation"] = end.aicc;
  }
  for (const Saturation &one : fit.bends)
    if (!one.degenerate)
      json["bends"].push_back({{"m", one.m},
                               {"L_c", one.L_c},
                               {"L_c_error", one.se_L_c},
                               {"s_inf", one.s_inf},
                               {"D", one.D},
                               {"D_error", one.se_D},
                               {"chi2", one.chi2}});
  json["preferred"] = to_string(fit.preferred);
  return json;
}

Figure scaling_figure(const std::vector<Scaling> &scalings, int width) {
  Figure figure{Table({"curve", "model", "length", "s_star", "error", "events", "error_independent",
                       "block", "blocks", "label"}),
                {},
                {}};
  figure.table.comment("characteristic size <s^2>/<s> in model energy units; errors: bootstrap");
  figure.table.comment(
      "block: length of the stretches of the catalogue that are resampled, model time; 0: events "
      "one by one; error_independent: if the events were independent");
  std::string plots, lines;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0, lowest = shortest,
         highest = 0.0;
  std::int64_t number = 0;
  for (const Scaling &scaling : scalings) {
    ++number;
    double from = std::numeric_limits<double>::infinity(), to = 0.0;
    for (std::size_t i = 0; i < scaling.points.size(); ++i) {
      const SizePoint &point = scaling.points[i];
      figure.table.add(number).add(scaling.model).add(point.length);
      figure.table.add(point.s_star).add(point.error).add(point.n).add(point.error_independent);
      figure.table.add(point.block).add(static_cast<std::int64_t>(point.blocks));
      figure.table.add(scaling.labels[i]).end_row();
      if (point.degenerate) continue;
      from = std::min(from, point.length);
      to = std::max(to, point.length);
      lowest = std::min(lowest, std::max(point.s_star - point.error, 0.1 * point.s_star));
      highest = std::max(highest, point.s_star + point.error);
    }
    if (!(to > 0.0)) continue;
    shortest = std::min(shortest, from);
    longest = std::max(longest, to);
    const std::string column = fmt::format("$1 == {} ? $3 : NaN", number);
    plots +=
        fmt::format("{}{}, \\\n     table using ({}):4 with points lt {} title {}",
                    plots.empty() ? "plot " : ", \\\n     ", error_bars(column, "$4", "$5", number),
                    column, number, quote(name_of(scaling) + ": s*"));
    const ScalingFit &fit = scaling.fit;
    if (fit.degenerate) continue;
    const std::string where = fmt::format("[{}:{}] '+' using 1:", text_io::number(0.85 * from),
                                          text_io::number(to / 0.85));
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
        text_io::number(0.85 * from), text_io::number(to / (0.85 * 0.85 * from)),
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
  figure.script = axis("x", name, true, 0.9 * shortest, 1.1 * longest) +
                  axis("y", "characteristic size s* (energy)", true, lowest, highest) +
                  std::string(error_bar_function) + plots + lines + "\n";
  return figure;
}

}  // namespace LSM::postproc
