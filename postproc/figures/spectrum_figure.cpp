// SPDX-License-Identifier: GPL-2.0-or-later
#include "spectrum_figure.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace LSM::postproc {

Figure spectrum_figure(const std::vector<SpectrumCurve> &curves) {
  Table table("curve,label,frequency,width,density,error");
  table.comment(
      "one-sided power spectral density of the potential energy; frequency, width: cycles / model "
      "time; density, error: model energy^2 x model time; sum of density x width = variance");
  Curves plot("$3", "$3 > 0 && $5 > 0");
  Extent frequencies, heights;
  std::int64_t number = 0;
  for (const SpectrumCurve &curve : curves) {
    ++number;
    for (const SpectrumPoint &point : curve.points) {
      table.row(number, curve.label, point.frequency, point.width, point.density, point.error);
      if (point.frequency <= 0.0 || !(point.density > 0.0)) continue;
      frequencies.add(point.frequency);
      heights.add(point.density);
    }
    plot.add(Curves::data, fmt::format("table using (row({0})):5 with lines lt {0}", number),
             curve.label);
  }
  if (heights.empty())
    throw std::runtime_error("the series do not vary, their spectra are 0: nothing to draw");
  return plot.figure(
      std::move(table),
      axis("x", "Frequency (cycles / model time)", true, frequencies.lo, frequencies.hi) +
          axis("y", "Spectral density of PE (energy^2 x time)", true,
               std::max(heights.lo, 1e-18 * heights.hi), heights.hi));
}

}  // namespace LSM::postproc
