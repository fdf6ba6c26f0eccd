// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_figures.h
/// Pictures of the ruptures of a fault, and of its slip in space and time †.
#ifndef LSM_POSTPROC_RUPTURE_FIGURES_H
#define LSM_POSTPROC_RUPTURE_FIGURES_H

#include <string>
#include <vector>

#include "files/catalogue.h"
#include "plot.h"
#include "ruptures.h"
#include "slip_window.h"

namespace LSM::postproc {

/// Numbers of the ruptures of one catalogue, see rupture_densities().
struct RuptureDensity {
  std::string label;
  double fault = 0.0;  ///< length of the fault
  std::vector<LogBin> bins;
};

/// Their numbers by length or by moment.
/// \param limit smallest moment that is seen; 0: not known
/// \throws std::runtime_error if there is nothing to draw
Figure rupture_density_figure(const std::vector<RuptureDensity> &densities,
                              RuptureQuantity quantity, double limit);

/// Moment against length, drop of the total PE against moment, and stress drop against moment.
Figure moment_length_figure(const RuptureRelations &relations);
Figure moment_pe_figure(const RuptureRelations &relations);
Figure stress_drop_figure(const RuptureRelations &relations);

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
