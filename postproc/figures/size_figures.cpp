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
PowerLine placed(PowerLine line, const std::vector<SizeDensity> &densities, const Range &sizes) {
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
  table.comment(
      "units: sizes in model energy, of earthquakes 10^(1.5 M); densities in 1 / size; errors: Poisson");
  Curves curves("$6", "$7 > 0");
  std::vector<std::int64_t> numbers;  // number of each catalogue's curve; 0: not drawn
  std::int64_t number = 0;
  Range sizes, heights;
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
  const bool magnitudes = std::all_of(densities.begin(), densities.end(),
                                      [](auto &one) { return one.model == seismicity; });
  return curves.figure(
      std::move(table),
      axis("x", magnitudes ? "event size s, 10^{1.5 M}" : "event size s (energy, model units)",
           true, sizes.lo, sizes.hi) +
          axis("y",
               magnitudes ? "probability density p(s)" : "probability density p(s) (1 / energy)",
               true, 0.3 * heights.lo, top));
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

}  // namespace LSM::postproc
