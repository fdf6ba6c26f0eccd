// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_figures.h
/// PE series: with the events picked from them, whether they stick and slip, and their spectra.
#ifndef LSM_POSTPROC_SERIES_FIGURES_H
#define LSM_POSTPROC_SERIES_FIGURES_H

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "events/event_picker.h"
#include "plot.h"
#include "regime.h"
#include "spectrum.h"
#include "thinner.h"

namespace LSM::postproc {

/// One PE series.
struct SeriesRegime {
  std::string path, model;
  double length = NAN;  ///< or number of blocks; NaN: not given
  std::int64_t samples = 0, events = 0;
  double first = 0.0, last = 0.0;  ///< times of the samples used
  std::optional<Regime> regime;
  std::string why;  ///< reason if there is none

  void take(const RegimeMeter &meter);
};

Table regime_table(const std::vector<SeriesRegime> &series);

/// PE, its change and the smoothed change from t0 to t1, with BASE-events.csv if events (paper:
/// Figs. 8 to 11).
Figure series_figure(const Thinner &curves, const std::string &title, double t0, double t1,
                     bool events, const PickerSettings &picker);

struct SpectrumCurve {
  std::string label;
  std::vector<SpectrumPoint> points;
  std::int64_t samples = 0, segments = 0;
  double averages = 0.0;  ///< independent segments with the same scatter
};

/// Power spectra †. \throws std::runtime_error if all densities are 0
Figure spectrum_figure(const std::vector<SpectrumCurve> &curves);

}  // namespace LSM::postproc

#endif
