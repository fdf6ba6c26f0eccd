// SPDX-License-Identifier: GPL-2.0-or-later
#include "spectrum_figure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

double variance(const SpectrumCurve &curve) {
  double sum = 0.0;
  for (const SpectrumPoint &point : curve.points) sum += point.density * point.width;
  return sum;
}

Figure spectrum_figure(const std::vector<SpectrumCurve> &curves, bool of_pe) {
  Figure figure{
      Table({"curve", "label", "frequency", "width", "density", "error"}), {}, {900, 640}};
  figure.table.comment(fmt::format(
      "one-sided power spectral density of {}; frequency, width: cycles / model time; density, "
      "error: model energy^2 x model time; sum of density x width = variance",
      of_pe ? "the potential energy" : "its change per sample"));
  double lo = HUGE_VAL, hi = 0.0, least = HUGE_VAL, most = 0.0;
  std::string plots;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const SpectrumCurve &curve = curves[i];
    for (const SpectrumPoint &point : curve.points) {
      figure.table.add(static_cast<std::int64_t>(i + 1))
          .add(curve.label)
          .add(point.frequency)
          .add(point.width)
          .add(point.density)
          .add(point.error)
          .end_row();
      if (point.frequency <= 0.0 || !(point.density > 0.0)) continue;
      lo = std::min(lo, point.frequency);
      hi = std::max(hi, point.frequency);
      least = std::min(least, point.density);
      most = std::max(most, point.density);
    }
    plots += fmt::format(
        "{} table using ($1 == {} && $3 > 0 && $5 > 0 ? $3 : NaN):5 with lines lt {} title {}",
        i == 0 ? "plot" : ", \\\n    ", i + 1, i + 1, quote(curve.label));
  }
  if (!(most > 0.0))
    throw std::runtime_error("the series do not vary, their spectra are 0: nothing to draw");
  figure.script = axis("x", "Frequency (cycles / model time)", true, lo, hi) +
                  axis("y",
                       of_pe ? "Spectral density of PE (energy^2 x time)"
                             : "Spectral density of the change of PE (energy^2 x time)",
                       true, std::max(least, 1e-18 * most), most) +
                  plots + "\n";
  return figure;
}

}  // namespace LSM::postproc
