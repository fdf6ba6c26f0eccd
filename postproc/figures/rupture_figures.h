// SPDX-License-Identifier: GPL-2.0-or-later
/// \file rupture_figures.h
/// Figures of the ruptures of a fault, and of its slip in space and time †.
#ifndef LSM_POSTPROC_RUPTURE_FIGURES_H
#define LSM_POSTPROC_RUPTURE_FIGURES_H

#include <string>
#include <vector>

#include "files/catalogue.h"
#include "plot.h"
#include "ruptures.h"
#include "slip_map.h"
#include "slip_window.h"

namespace LSM::postproc {

/// Density of the ruptures of one catalogue, see rupture_densities().
struct RuptureDensity {
  std::string label;
  double fault = 0.0;  ///< length of the fault
  std::vector<LogBin> bins;
};

/// Density of the ruptures by length or by moment.
/// \param limit smallest moment that can be detected; 0: not known
/// \throws DegenerateData if there is nothing to draw
Figure rupture_density_figure(const std::vector<RuptureDensity> &densities,
                              RuptureQuantity quantity, double limit);

/// Slip moment against length of the rupture, with the fitted power law.
Figure moment_length_figure(const RuptureRelations &relations);
/// Drop of the total PE against slip moment, with the fits of all ruptures and of those that are
/// isolated in time.
Figure moment_pe_figure(const RuptureRelations &relations);
/// Mean stress drop against slip moment, with its means over half decades of the moment.
Figure stress_drop_figure(const RuptureRelations &relations);

/// Slip velocity in space and time, with the outlines of the largest ruptures.
/// \param outlines gets the outlines; the script reads it as BASE-outlines.csv
Figure space_time_figure(const HistoryWindow &window, Table &outlines);
/// Slip along the fault since the beginning of the window.
/// \param locked time between lines
/// \param slipping time between lines while any part of the fault slips
Figure slip_lines_figure(const HistoryWindow &window, double locked, double slipping);
/// One rupture: slip velocity around its hypocentre, with the fronts of P- and S-waves as lines,
/// and its slip along the fault.
/// \param lines gets outline, wave fronts and slip; the script reads it as BASE-lines.csv
Figure rupture_detail_figure(const HistoryWindow &window, const Event &event, double p_speed,
                             double s_speed, Table &lines);

/// Maps of one rupture on a plane: its slip; the time at which it came, with contours; its largest
/// slip velocity.
Figure slip_map_figure(const SlipMap &map, const Event &event);
/// \param lines gets the contours; the script reads it as BASE-contours.csv
Figure rupture_time_figure(const SlipMap &map, const Event &event, Table &lines);
Figure slip_rate_figure(const SlipMap &map, const Event &event);
/// Its moment per time, and the components of it.
Figure moment_rate_figure(const SlipMap &map, const Event &event);

}  // namespace LSM::postproc

#endif
