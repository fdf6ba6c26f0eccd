// SPDX-License-Identifier: GPL-2.0-or-later
#include "size_figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "files/text.h"
#include "numbers.h"

namespace LSM::postproc {

namespace {

/// Sets the missing ends of a line, and a missing amplitude so that the line lies above all points
/// between its ends. The amplitude is 0 if there are no such points.
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
                           const std::vector<PowerLine> &lines) {
  // Labels may contain commas. They come last so that `awk -F,` finds the numbers.
  Table table("curve,model,length,bin_lo,bin_hi,size,count,density,error,label");
  table.comment("units: sizes in model energy, densities in 1 / model energy; errors: Poisson");
  Curves curves("$6", "$7 > 0");
  std::vector<std::int64_t> numbers;  // number of each catalogue's curve; 0: not drawn
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
    // Lines and points are separate because `with linespoints` surrounds points with white in SVG.
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
    // Colours are numbered by the curves that are drawn, not by all catalogues.
    const std::int64_t curve = line.catalogue < numbers.size() ? numbers[line.catalogue] : 0;
    curves.add_law(
        line.lo, line.hi,
        fmt::format("{}*$1**({})", text::number(line.amplitude), text::number(line.slope)),
        fmt::format("lt {} dt {} lw 2.2", curve > 0 ? curve : 8, line.dash), line.title);
  }
  return curves.figure(
      std::move(table),
      axis("x", "event size s (energy, model units)", true, sizes.lo, sizes.hi) +
          axis("y", "probability density p(s) (1 / energy)", true, 0.3 * heights.lo, top));
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

namespace {

/// Adds the laws fitted to the characteristic sizes, over a range of lengths.
void add_laws(Curves &curves, const ScalingFit &fit, std::int64_t number, const Extent &lengths) {
  const double lo = 0.85 * lengths.lo, hi = lengths.hi / 0.85;
  const auto exact = [](double value) { return text::number(value); };
  curves.add_law(lo, hi, fmt::format("{}*$1**({})", exact(fit.A), exact(fit.D)),
                 fmt::format("lt {}", number),
                 fmt::format("A L^D with D = {}", with_error(fit.D, fit.se_D, " ± ")), quote_plain);
  curves.add_law(lo, hi, exact(fit.constant), "lt 8 dt 2", "constant");
  if (fit.preferred != SizeDependence::saturates) return;
  const Saturation &end = fit.saturation;
  // Sampled evenly in ln L, so that the bend looks smooth.
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

Figure scaling_figure(const std::vector<Scaling> &scalings) {
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
    throw DegenerateData("finite-size scaling: no catalogue gives a characteristic size");
  return curves.figure(
      scaling_table(scalings),
      axis("x",
           faults && chains ? "length of the fault, or number of blocks"
           : faults         ? "length of the fault"
                            : "number of blocks",
           true, 0.9 * lengths.lo, 1.1 * lengths.hi) +
          axis("y", "characteristic size s* (energy)", true, heights.lo, heights.hi));
}

}  // namespace LSM::postproc
