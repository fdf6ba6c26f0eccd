// SPDX-License-Identifier: GPL-2.0-or-later
// Results of finite-size scaling, in words.
#include <fmt/format.h>

#include "numbers.h"
#include "size_figures.h"

namespace LSM::postproc {

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

/// States by how much error_scale() enlarged the errors, if it did.
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

}  // namespace LSM::postproc
