// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_figures.h
/// PE series: the events picked from them, and whether they show stick-slip or creep.
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
#include "thinner.h"

namespace LSM::postproc {

/// One PE series and its regime.
struct SeriesRegime {
  std::string path, model;
  double length = NAN;  ///< of the fault, or number of blocks; NaN: not given
  std::int64_t samples = 0, events = 0;
  double first = 0.0, last = 0.0;  ///< times of the first and last sample used
  std::optional<Regime> regime;
  std::string why;  ///< reason if there is no regime

  /// Sets `regime`, or `why` if the meter has no result.
  void take(const RegimeMeter &meter);
};

/// Regimes, a row per series.
Table regime_table(const std::vector<SeriesRegime> &series);

/// PE, its change and the smoothed change from t0 to t1 (paper: Figs. 8 to 11).
/// \param events whether to draw the events in BASE-events.csv as well
/// \param picker settings that are named in the key
Figure series_figure(const Thinner &curves, const std::string &title, double t0, double t1,
                     bool events, const PickerSettings &picker);

}  // namespace LSM::postproc

#endif
