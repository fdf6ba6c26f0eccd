// SPDX-License-Identifier: GPL-2.0-or-later
#include "spectrum_figure.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "numbers.h"

namespace LSM::postproc {

double variance(const SpectrumCurve &curve) {
  double sum = 0.0;
  for (const SpectrumPoint &point : curve.points) sum += point.density * point.width;
  return sum;
}

Figure spectrum_figure(const std::vector<SpectrumCurve> &curves, bool of_pe) {
  Figure figure{Table("curve,label,frequency,width,density,error"), {}, {900, 640}};
  figure.table.comment(fmt::format(
      "one-sided power spectral density of {}; frequency, width: cycles / model time; density, "
      "error: model energy^2 x model time; sum of density x width = variance",
      of_pe ? "the potential energy" : "its change per sample"));
  Extent frequencies, heights;
  std::string plots;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const SpectrumCurve &curve = curves[i];
    for (const SpectrumPoint &point : curve.points) {
      figure.table.row(i + 1, curve.label, point.frequency, point.width, point.density,
                       point.error);
      if (point.frequency <= 0.0 || !(point.density > 0.0)) continue;
      frequencies.add(point.frequency);
      heights.add(point.density);
    }
    plots += fmt::format(
        "{} table using ($1 == {} && $3 > 0 && $5 > 0 ? $3 : NaN):5 with lines lt {} title {}",
        i == 0 ? "plot" : ", \\\n    ", i + 1, i + 1, quote(curve.label));
  }
  if (heights.empty())
    throw std::runtime_error("the series do not vary, their spectra are 0: nothing to draw");
  figure.script =
      axis("x", "Frequency (cycles / model time)", true, frequencies.lo, frequencies.hi) +
      axis("y",
           of_pe ? "Spectral density of PE (energy^2 x time)"
                 : "Spectral density of the change of PE (energy^2 x time)",
           true, std::max(heights.lo, 1e-18 * heights.hi), heights.hi) +
      plots + "\n";
  return figure;
}

}  // namespace LSM::postproc
