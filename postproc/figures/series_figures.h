// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_figures.h
/// PE series and the events picked from them.
#ifndef LSM_POSTPROC_SERIES_FIGURES_H
#define LSM_POSTPROC_SERIES_FIGURES_H

#include <string>

#include "events/event_picker.h"
#include "plot.h"
#include "thinner.h"

namespace LSM::postproc {

/// PE, its change and the smoothed change from t0 to t1 (paper: Figs. 8 to 11).
/// \param events whether to draw the events in BASE-events.csv as well
/// \param picker settings that are named in the key
Figure series_figure(const Thinner &curves, const std::string &title, double t0, double t1,
                     bool events, const PickerSettings &picker);

}  // namespace LSM::postproc

#endif
