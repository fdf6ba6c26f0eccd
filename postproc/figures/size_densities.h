// SPDX-License-Identifier: GPL-2.0-or-later
/// \file size_densities.h
/// Densities of event sizes over logarithmic bins, one curve per catalogue (paper: Figs. 7, 12,
/// 13).
#ifndef LSM_POSTPROC_SIZE_DENSITIES_H
#define LSM_POSTPROC_SIZE_DENSITIES_H

#include <limits>
#include <string>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"
#include "plot.h"

namespace LSM::postproc {

/// Straight line in the logarithms: amplitude * s^slope from lo to hi.
struct PowerLine {
  double slope = -1.0;
  double lo = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the range of the data
  double hi = std::numeric_limits<double>::quiet_NaN();
  double amplitude = std::numeric_limits<double>::quiet_NaN();  ///< NaN: above all points
  std::string title;                                            ///< empty: no line in the key
  /// Index of the catalogue whose colour it has; none: black.
  std::size_t catalogue = std::numeric_limits<std::size_t>::max();
  int dash = 2;  ///< gnuplot dash type
};

struct SizeDensitySettings {
  Threshold threshold;                                    ///< smallest size (model energy)
  double upto = std::numeric_limits<double>::infinity();  ///< largest size
  double factor = LogHistogram::default_factor;           ///< ratio of the edges of a bin
  bool counts = false;                                    ///< events per bin instead of densities
  std::vector<PowerLine> lines;
  int width = 900;  ///< of the picture
};

/// Table and picture of the densities with Poisson errors. Catalogues without an event in the range
/// have no curve; they are named in `empty`.
/// \throws std::invalid_argument for impossible settings; std::runtime_error if no catalogue has
/// an event in the range
Figure size_density_figure(const std::vector<EventTable> &tables,
                           const SizeDensitySettings &settings, std::vector<std::string> &empty);

}  // namespace LSM::postproc

#endif
