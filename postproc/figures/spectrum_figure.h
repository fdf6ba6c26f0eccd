// SPDX-License-Identifier: GPL-2.0-or-later
/// \file spectrum_figure.h
/// Power spectra of PE series (ours).
#ifndef LSM_POSTPROC_SPECTRUM_FIGURE_H
#define LSM_POSTPROC_SPECTRUM_FIGURE_H

#include <cstdint>
#include <string>
#include <vector>

#include "plot.h"
#include "spectrum.h"

namespace LSM::postproc {

struct SpectrumCurve {
  std::string label;
  std::vector<SpectrumPoint> points;
  std::int64_t samples = 0, segments = 0;
  double averages = 0.0;  ///< independent segments with the same scatter
};

/// \throws std::runtime_error if all densities are 0
Figure spectrum_figure(const std::vector<SpectrumCurve> &curves);

}  // namespace LSM::postproc

#endif
