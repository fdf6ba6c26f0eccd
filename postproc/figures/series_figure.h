// SPDX-License-Identifier: GPL-2.0-or-later
/// \file series_figure.h
/// A PE series with the events picked from it (paper: Figs. 8 to 11).
#ifndef LSM_POSTPROC_SERIES_FIGURE_H
#define LSM_POSTPROC_SERIES_FIGURE_H

#include <string>

#include "lsm_event_picker.h"
#include "plot.h"
#include "thinner.h"

namespace LSM::postproc {

/// PE, its change and the smoothed change from t0 to t1, with BASE-events.csv if events.
Figure series_figure(const Thinner &curves, const std::string &title, double t0, double t1,
                     bool events, const PickerSettings &picker);

}  // namespace LSM::postproc

#endif
