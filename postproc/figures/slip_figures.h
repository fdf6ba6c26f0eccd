// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slip_figures.h
/// A fault in space and time from its slip history (ours).
#ifndef LSM_POSTPROC_SLIP_FIGURES_H
#define LSM_POSTPROC_SLIP_FIGURES_H

#include "lsm_catalogue.h"
#include "plot.h"
#include "slip_window.h"

namespace LSM::postproc {

/// Slip velocity in space and time with the ruptures outlined.
/// \param outlines path of a second table that the script reads
Figure space_time_figure(const HistoryWindow &window, Table &outlines);
/// Lines of the slip along the fault since the beginning of the window, one every `locked` time
/// units, and one every `slipping` while anything slips.
Figure slip_lines_figure(const HistoryWindow &window, double locked, double slipping);
/// One rupture: slip velocity around its first place, with two wave speeds as slopes, and its slip.
Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines);

}  // namespace LSM::postproc

#endif
