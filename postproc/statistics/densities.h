// SPDX-License-Identifier: GPL-2.0-or-later
/// \file densities.h
/// Densities of event sizes over logarithmic bins, one curve per catalogue (paper: Figs. 7, 12,
/// 13).
#ifndef LSM_POSTPROC_DENSITIES_H
#define LSM_POSTPROC_DENSITIES_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "event_table.h"
#include "log_histogram.h"
#include "power_law.h"

namespace LSM::postproc {

struct DensitySettings {
  Threshold threshold;                                    ///< smallest size (model energy)
  double upto = std::numeric_limits<double>::infinity();  ///< largest size
  double factor = usual_bin_factor;                       ///< ratio of the edges of a bin
};

/// The sizes of one catalogue. The range applies to them as they are in the catalogue.
struct SizeDensity {
  std::string label, model;
  double length = 0.0;       ///< see EventTable::length()
  double largest = 0.0;      ///< size in the catalogue
  std::int64_t events = 0;   ///< in the bins
  std::vector<LogBin> bins;  ///< with Poisson errors; empty: no event in the range
};

/// In the order of the catalogues.
/// \throws std::invalid_argument for impossible settings; std::runtime_error if no catalogue has an
/// event in the range
std::vector<SizeDensity> size_densities(const std::vector<EventTable> &tables,
                                        const DensitySettings &settings);

/// C of the density C s^-alpha of all events in the bins along a law fitted to some of them.
double amplitude_of(const PowerLawFit &law, const SizeDensity &density);

}  // namespace LSM::postproc

#endif
